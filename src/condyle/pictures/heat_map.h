#pragma once

/// A table of numbers of both signs as coloured cells, through gnuplot: panels of the same
/// rows and columns. The numbers stand in the cells.

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "condyle/pictures/plot_format.h"

namespace condyle {

struct HeatMap {
  struct Row {
    std::string name, note;  ///< the note stands after the name
  };
  struct Column {
    std::string name;
    std::size_t scale = 0;  ///< whose colours it has
  };
  /// Colours go from -largest to +largest, white in the middle, or from 0 where nothing is negative;
  /// columns of one scale stand together.
  struct Scale {
    std::string title, unit;  ///< of its columns
    double largest = 0;
    bool from_zero = false;
  };
  struct Panel {
    std::string title;
    std::vector<double> values;  ///< by rows; NaN: no number
  };
  std::string title, what;         ///< what it is of, and what it shows
  std::vector<std::string> notes;  ///< lines below the title
  std::vector<Row> rows;
  std::vector<Column> columns;
  std::vector<Scale> scales;
  std::vector<Panel> panels;
  std::size_t beside = 2;  ///< panels beside each other; the others go below
};

struct NamedMap {
  std::string name;  ///< of the file, without its ending
  HeatMap map;
};

/// The script that draws it.
[[nodiscard]] std::string gnuplot_script(const HeatMap& map, PlotFormat format);

}  // namespace condyle
