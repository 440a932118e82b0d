#pragma once

/// Pages of panels side by side, through gnuplot: for bands, measured points, bars and cells of a
/// matrix, where `Chart` has lines over one abscissa. Pixels are told from the upper left corner.

#include <array>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "condyle/pictures/mark.h"
#include "condyle/pictures/plot_format.h"

namespace condyle {

/// Words at a place of the axes.
struct Words {
  double x = 0, y = 0;
  std::string text;
  bool light = false;  ///< on a dark ground
};

struct PagePanel {
  std::string title, x_label, y_label;
  std::vector<Mark> marks;
  static constexpr double kFree = std::numeric_limits<double>::quiet_NaN();
  std::array<double, 2> x_range = {kFree, kFree}, y_range = {kFree, kFree};
  bool from_zero = false;  ///< the axis of y begins at 0 where nothing is negative
  std::vector<std::string> x_names = {}, y_names = {};  ///< of 0, 1, ... in place of numbers
  std::vector<std::string> right_names = {};            ///< of the rows, right of the axes
  std::vector<Words> words = {};
  bool log_y = false, frame = true;
  double name_size = 10;                            ///< of names [point]
  double left = 0, top = 0, width = 0, height = 0;  ///< of the axes [pixel]
};

struct KeyEntry {
  std::string words;
  std::vector<Mark> samples;  ///< only their looks count
};

struct ChartPage {
  std::string title, what;
  std::vector<std::string> notes = {};  ///< lines below the title
  std::vector<KeyEntry> key = {};
  std::vector<PagePanel> panels = {};
  int width = 1200, height = 0;  ///< [pixel]
};

struct NamedPage {
  std::string name;  ///< of the file, without its ending
  ChartPage page;
};

inline constexpr std::size_t kMostPanels = 12;  ///< of a page in three columns
inline constexpr int kPanelColumns = 3;

/// Height of title, notes and key: where panels may begin [pixel].
[[nodiscard]] double top_of_panels(const ChartPage& page);

/// Puts all panels side by side in rows of `columns`, and gives the page its height.
void lay_in_grid(ChartPage& page, int columns, double panel_height);

/// The panels of each over as many pages as they need, `most` on one; "name", or "name_1", "name_2", ...
[[nodiscard]] std::vector<NamedPage> divided(const std::vector<NamedPage>& pages,
                                             std::size_t most,
                                             int columns,
                                             double panel_height);

[[nodiscard]] std::string gnuplot_script(const ChartPage& page, PlotFormat format);

}  // namespace condyle
