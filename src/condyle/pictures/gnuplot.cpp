#include "condyle/pictures/gnuplot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "condyle/pictures/fitted_words.h"
#include "condyle/pictures/gnuplot_page.h"

namespace condyle {
namespace {

constexpr int kWidth = kPageWidth, kPanelHeight = 400, kPanelGap = 34, kFootHeight = 84;  // [pixel]

constexpr std::array<int, 4> kDashes = {1, 2, 4, 5};
/// By runs: styles of lines, and of points that stand alone.
constexpr std::array<const char*, 6> kRunDashes = {"1", "2", "3", "4", "5", "(24,6)"};
constexpr std::array<int, 6> kRunPoints = {7, 6, 5, 4, 9, 8};
static_assert(kRunPoints.size() == kMostRunsOverEachOther &&
              kRunDashes.size() == kMostRunsOverEachOther);
constexpr double kLeft = 0.09;            // of the page, left of the axes
constexpr double kTitleMargin = 12;       // [pixel]
constexpr double kLetter = 9.2;           // width of one in the legend [pixel]
constexpr std::size_t kLongestName = 40;  // in the legend, letters
constexpr std::size_t kManyPoints = 60;   // more are not marked one by one
constexpr const char* kHollowName = "left patch";

using Numbers = std::vector<double>;

bool has_points(const Numbers& x, const Numbers& y) {
  for (std::size_t i = 0; i < x.size() && i < y.size(); ++i) {
    if (std::isfinite(x[i]) && std::isfinite(y[i])) return true;
  }
  return false;
}

bool has_line(const Curve& curve) { return has_points(curve.x, curve.y); }
bool has_hollow(const Curve& curve) { return has_points(curve.hollow_x, curve.hollow_y); }
bool has_points(const Curve& curve) { return has_line(curve) || has_hollow(curve); }
bool has_hollow(const Panel& panel) {
  return std::any_of(panel.curves.begin(), panel.curves.end(),
                     [](const Curve& curve) { return has_hollow(curve); });
}

/// Right end of the axes, of the page: the legend has its place beside them.
double right_end(const Chart& chart) {
  std::size_t longest = 0;
  for (const Panel& panel : chart.panels) {
    for (const Curve& curve : panel.curves) longest = std::max(longest, letters(curve.title));
    if (has_hollow(panel)) longest = std::max(longest, letters(kHollowName));
  }
  for (const std::string& run : chart.runs) longest = std::max(longest, letters(run));
  if (longest == 0) return 0.97;
  const double legend = 100 + kLetter * static_cast<double>(std::min(longest, kLongestName + 1));
  return 1 - legend / kWidth;
}

std::string point_block(const std::string& name, const Numbers& x, const Numbers& y) {
  std::string lines;
  for (std::size_t i = 0; i < x.size() && i < y.size(); ++i) {
    const bool known = std::isfinite(x[i]) && std::isfinite(y[i]);
    lines += known ? fmt::format("{:.9g} {:.9g}\n", x[i], y[i]) : "\n";
  }
  return data_block(name, lines);
}

/// Of the points that a line shows nothing of; empty where there are none.
std::string lone_block(const std::string& name, const Curve& curve) {
  std::string lines;
  for (const std::size_t i : lone_points(curve.x, curve.y))
    lines += fmt::format("{:.9g} {:.9g}\n", curve.x[i], curve.y[i]);
  return lines.empty() ? "" : data_block(name, lines);
}

/// Broken where the curve is.
std::string band_block(const std::string& name, const Curve& curve) {
  std::string lines;
  for (std::size_t i = 0; i < curve.low.size(); ++i) {
    const bool known = std::isfinite(curve.x[i]) && std::isfinite(curve.y[i]) &&
                       std::isfinite(curve.low[i]) && std::isfinite(curve.high[i]);
    lines += known ? fmt::format("{:.9g} {:.9g} {:.9g}\n", curve.x[i], curve.low[i], curve.high[i])
                   : "\n";
  }
  return data_block(name, lines);
}

std::string band_command(std::size_t color, const std::string& data) {
  return fmt::format(
      "${} using 1:2:3 with filledcurves fillcolor '{}' fillstyle transparent solid 0.18 noborder "
      "notitle, ",
      data, kColors[color % kColors.size()]);
}

Title title_of(const Chart& chart) {
  return page_title(chart.title, chart.what, (1 - kLeft) * kWidth - kTitleMargin);
}

std::string head(const Chart& chart, PlotFormat format, int height) {
  return plot_style(format, kWidth, height) +
         fmt::format("set lmargin at screen {}\nset rmargin at screen {:.5f}\n", kLeft,
                     right_end(chart)) +
         "set multiplot\n" + title_labels(title_of(chart), kLeft, format, height);
}

std::size_t color_of(const Curve& curve, std::size_t index) {
  return curve.color < 0 ? index : static_cast<std::size_t>(curve.color);
}

std::string hollow_command(const Curve& curve, std::size_t color, const std::string& data) {
  if (!has_hollow(curve)) return "";
  return fmt::format(
      ", ${} using 1:2 with points pointtype 6 pointsize 1.1 linewidth 1.6 linecolor '{}' notitle",
      data, kColors[color % kColors.size()]);
}

/// What hollow circles are.
std::string hollow_legend(const Panel& panel) {
  if (!has_hollow(panel)) return "";
  return fmt::format(
      ", NaN with points pointtype 6 pointsize 1.1 linewidth 1.6 linecolor '#303840' title {}",
      quoted_words(kHollowName));
}

/// Few points of one run are marked one by one.
bool is_marked(const Chart& chart, const Curve& curve) {
  return chart.runs.empty() && curve.x.size() <= kManyPoints;
}

std::string lone_command(const Chart& chart,
                         const Curve& curve,
                         std::size_t color,
                         const std::string& data) {
  const auto run = static_cast<std::size_t>(curve.style) % kRunPoints.size();
  return fmt::format(
      ", ${} using 1:2 with points pointtype {} pointsize 0.5 linecolor '{}' notitle", data,
      chart.runs.empty() ? 7 : kRunPoints[run], kColors[color % kColors.size()]);
}

/// One curve of the plot command; a title that stands in the legend already is left out there.
std::string curve_command(const Chart& chart,
                          const Panel& panel,
                          std::size_t index,
                          const std::string& data) {
  const Curve& curve = panel.curves[index];
  const std::size_t color = color_of(curve, index);
  const int dash = curve.dashed ? 2 : kDashes[color / kColors.size() % kDashes.size()];
  const auto run = static_cast<std::size_t>(curve.style) % kRunDashes.size();
  const std::string points =
      is_marked(chart, curve)
          ? fmt::format("linespoints pointtype {} pointsize 0.35", curve.dashed ? 6 : 7)
          : "lines";
  const bool keyed = chart.runs.empty() && !curve.title.empty();
  return fmt::format(
      "{} with {} linewidth {} linecolor '{}' dashtype {} {}",
      has_line(curve) ? "$" + data + " using 1:2" : "NaN", points, 2,
      kColors[color % kColors.size()],
      chart.runs.empty() ? fmt::format("{}", dash) : kRunDashes[run],
      keyed ? "title " + quoted_words(shortened(curve.title, kLongestName)) : "notitle");
}

/// Legend of several runs: a colour for each title, a line style for each run.
std::string run_legend(const Chart& chart, const Panel& panel, bool with_runs) {
  std::string commands;
  const auto entry = [&](const std::string& title, const char* color, const char* dash) {
    commands += fmt::format(", NaN with lines linewidth 2 linecolor '{}' dashtype {} title {}",
                            color, dash, quoted_words(shortened(title, kLongestName)));
  };
  std::vector<std::string> known;
  for (const Curve& curve : panel.curves) {
    if (curve.title.empty() || !has_points(curve)) continue;
    if (std::find(known.begin(), known.end(), curve.title) != known.end()) continue;
    known.push_back(curve.title);
    entry(curve.title, kColors[static_cast<std::size_t>(curve.color) % kColors.size()], "1");
  }
  for (std::size_t i = 0; with_runs && i < chart.runs.size(); ++i)
    entry(chart.runs[i], "#303840", kRunDashes[i % kRunDashes.size()]);
  return commands;
}

/// Whether anything of the panel lies there: an axis without points is none.
template <typename There>
bool reaches(const Panel& panel, const There& there) {
  return std::any_of(panel.curves.begin(), panel.curves.end(), [&](const Curve& curve) {
    return std::any_of(curve.y.begin(), curve.y.end(), there) ||
           std::any_of(curve.hollow_y.begin(), curve.hollow_y.end(), there) ||
           std::any_of(curve.low.begin(), curve.low.end(), there);
  });
}

std::string y_range(const Panel& panel) {
  if (panel.from_zero && !reaches(panel, [](double y) { return y < 0; })) return "[0:*]";
  const bool bounded = panel.floor && reaches(panel, [&](double y) { return y > *panel.floor; });
  return bounded ? fmt::format("[{:g}<*:*]", *panel.floor) : "[*:*]";
}

std::string panel_script(const Chart& chart, std::size_t index, int height) {
  const Panel& panel = chart.panels[index];
  const double top =
      1 - (head_height(title_of(chart)) + static_cast<double>(index) * (kPanelHeight + kPanelGap)) /
              height;
  const bool last = index + 1 == chart.panels.size();
  std::string script = fmt::format("set tmargin at screen {:.5f}\nset bmargin at screen {:.5f}\n",
                                   top, top - static_cast<double>(kPanelHeight) / height);
  script += fmt::format(
      "set key at screen {:.5f}, screen {:.5f} left top Left reverse vertical samplen 2.4 spacing "
      "1.25 textcolor '#303840'\n",
      right_end(chart) + 0.015, top);
  script += "set yrange " + y_range(panel) + "\n";
  script += last ? "set format x '%g'\n" : "set format x ''\n";
  script += "set ylabel " + quoted_words(panel.y_label) + " textcolor '#303840'\n";
  script += "set xlabel " + quoted_words(last ? chart.x_label : "") + " textcolor '#303840'\n";
  std::string commands;
  for (std::size_t i = 0; i < panel.curves.size(); ++i) {
    if (!has_points(panel.curves[i])) continue;
    const std::string name = fmt::format("panel{}curve{}", index, i);
    const Curve& curve = panel.curves[i];
    script += point_block(name, curve.x, curve.y);
    if (has_hollow(curve)) script += point_block(name + "hollow", curve.hollow_x, curve.hollow_y);
    if (!curve.low.empty()) script += band_block(name + "band", curve);
    const std::string alone = is_marked(chart, curve) ? "" : lone_block(name + "alone", curve);
    script += alone;
    commands += commands.empty() ? "plot " : ", ";
    if (!curve.low.empty()) commands += band_command(color_of(curve, i), name + "band");
    commands += curve_command(chart, panel, i, name) +
                hollow_command(curve, color_of(curve, i), name + "hollow");
    if (!alone.empty()) commands += lone_command(chart, curve, color_of(curve, i), name + "alone");
  }
  if (!commands.empty() && !chart.runs.empty()) commands += run_legend(chart, panel, index == 0);
  if (!commands.empty()) commands += hollow_legend(panel);
  if (commands.empty()) commands = "set xrange [0:1]\nset yrange [0:1]\nplot NaN notitle";
  return script + commands + "\nunset label\n";
}

}  // namespace

std::string gnuplot_script(const Chart& chart, PlotFormat format) {
  const int height = head_height(title_of(chart)) + kFootHeight - kPanelGap +
                     (kPanelHeight + kPanelGap) * static_cast<int>(chart.panels.size());
  std::string script = head(chart, format, height);
  for (std::size_t i = 0; i < chart.panels.size(); ++i) script += panel_script(chart, i, height);
  return script + "unset multiplot\nunset output\n";
}

}  // namespace condyle
