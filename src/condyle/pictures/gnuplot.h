#pragma once

/// Plots through gnuplot, the maintained plotting program of the distribution. A chart is plain
/// data; here it becomes a gnuplot script, which gnuplot reads from a pipe.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "condyle/pictures/plot_format.h"

namespace condyle {

/// NaN where there is no value: a gap in the line.
struct Curve {
  std::string title;
  std::vector<double> x, y;
  int color = -1;       ///< of the list of colours; -1: the next one
  bool dashed = false;  ///< a second curve in the colour of a first
  int style = 0;        ///< of the line, where several runs lie over each other: which run
  std::vector<double> hollow_x = {}, hollow_y = {};  ///< points that are no results: hollow circles
  std::vector<double> low = {}, high = {};  ///< of a band about it, at each x; none: no band
};

struct Panel {
  std::string y_label;
  std::vector<Curve> curves;
  bool from_zero = false;            ///< the axis begins at 0 where nothing is negative
  std::optional<double> floor = {};  ///< the axis does not reach below: what is there is cut off
};

inline constexpr std::size_t kMostRunsOverEachOther = 6;  ///< each with a style of its own

/// Panels one above the other over the same abscissa, legends to their right.
struct Chart {
  std::string title, what;  ///< whose curves, and what they are
  std::string x_label;
  std::vector<Panel> panels;
  std::vector<std::string> runs = {};  ///< names of the line styles; none where there is one run
};

/// The script that draws it.
[[nodiscard]] std::string gnuplot_script(const Chart& chart, PlotFormat format);

}  // namespace condyle
