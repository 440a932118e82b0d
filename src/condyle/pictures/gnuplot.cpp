#include "condyle/pictures/gnuplot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "condyle/input_error.h"
#include "condyle/pictures/picture_error.h"
#include "condyle/pictures/run_program.h"
#include "condyle/pictures/text.h"
#include "condyle/results/output_file.h"

namespace condyle {
namespace {

constexpr int kWidth = 1200, kPanelHeight = 400, kPanelGap = 34, kHeadHeight = 80,
              kFootHeight = 84;  // [pixel]

/// Okabe and Ito's colours for every kind of sight; lines beyond their number are dashed.
constexpr std::array<const char*, 8> kColors = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                                "#E69F00", "#56B4E9", "#000000", "#8C6BB1"};
constexpr std::array<int, 4> kDashes = {1, 2, 4, 5};
constexpr std::array<int, 5> kRunDashes = {1, 2, 3, 4, 5};
constexpr double kLeft = 0.09;            // of the page, left of the axes
constexpr double kLetter = 9.2;           // width of one in the legend [pixel]
constexpr std::size_t kLongestName = 40;  // in the legend, letters
constexpr double kTitleSize = 16, kLeastTitleSize = 11, kPdfTitleSize = 8.5;  // [point]
constexpr int kTitleLine = 28, kTitleMargin = 12;                             // [pixel]
constexpr double kPixelPerPoint = 4.0 / 3;  // of gnuplot's PNG and SVG
constexpr std::size_t kManyPoints = 60;     // more are not marked one by one
constexpr double kPdfWidth = 7;             // [inch]: two columns of a journal
constexpr const char* kHollowName = "left patch";

/// In single quotes gnuplot takes everything as it is, except the quote itself.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) {
    if (c == '\'')
      result += "''";
    else
      result += static_cast<unsigned char>(c) < 32 ? ' ' : c;
  }
  return result + "'";
}

/// At most `most` letters of UTF-8.
std::string shortened(const std::string& text, std::size_t most) {
  std::size_t letters = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if ((static_cast<unsigned char>(text[i]) & 0xC0U) == 0x80U) continue;
    if (letters++ == most) return text.substr(0, i) + "…";
  }
  return text;
}

std::size_t letters(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
  }));
}

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

std::string data_block(const std::string& name, const Numbers& x, const Numbers& y) {
  std::string block = "$" + name + " << END_OF_DATA\n";
  for (std::size_t i = 0; i < x.size() && i < y.size(); ++i) {
    const bool known = std::isfinite(x[i]) && std::isfinite(y[i]);
    block += known ? fmt::format("{:.9g} {:.9g}\n", x[i], y[i]) : "\n";
  }
  return block + "END_OF_DATA\n";
}

std::string terminal(PlotFormat format, int height) {
  switch (format) {
    case PlotFormat::kPng:
      return fmt::format("pngcairo size {},{} font 'DejaVu Sans,13'", kWidth, height);
    case PlotFormat::kSvg:
      return fmt::format("svg size {},{} font 'DejaVu Sans,13'", kWidth, height);
    case PlotFormat::kPdf:
      // The same page, set smaller: letters of 7 points on a width of two columns.
      return fmt::format(
          "pdfcairo size {}in,{:.4f}in font 'DejaVu Sans,7' fontscale 0.75 pointscale 0.6",
          kPdfWidth, kPdfWidth * height / kWidth);
  }
  return "";
}

/// The title in one line or, where that is too long, in two, smaller where it has to be.
struct Title {
  std::vector<std::string> lines;
  double size = kTitleSize;  // [point]
};

double widest(const std::vector<std::string>& lines, double size) {
  Font font(true);
  double width = 0;
  for (const std::string& line : lines)
    width = std::max(width, static_cast<double>(font.width(
                                line, static_cast<int>(std::ceil(kPixelPerPoint * size)))));
  return width;
}

Title title_of(const Chart& chart) {
  const double room = (1 - kLeft) * kWidth - kTitleMargin;
  if (chart.title.empty()) return {{chart.what}};
  const Title one{{chart.title + ": " + chart.what}};
  if (widest(one.lines, one.size) <= room) return one;
  Title two{{chart.title + ":", chart.what}};
  while (two.size > kLeastTitleSize && widest(two.lines, two.size) > room) two.size -= 0.5;
  for (std::string& line : two.lines) {
    for (std::size_t n = letters(line); n > 1 && widest({line}, two.size) > room; --n)
      line = shortened(line, n - 1);
  }
  return two;
}

/// Above the panels [pixel].
int head_height(const Chart& chart) {
  return kHeadHeight + kTitleLine * (static_cast<int>(title_of(chart).lines.size()) - 1);
}

std::string title_labels(const Chart& chart, PlotFormat format, int height) {
  const Title title = title_of(chart);
  const double size =
      format == PlotFormat::kPdf ? kPdfTitleSize * title.size / kTitleSize : title.size;
  std::string script;
  for (std::size_t i = 0; i < title.lines.size(); ++i)
    script += fmt::format(
        "set label {} {} at screen {}, screen {:.5f} font 'DejaVu Sans Bold,{:g}' textcolor "
        "'#262c34'\n",
        i + 1, quoted(title.lines[i]), kLeft,
        1 - (0.45 * kHeadHeight + kTitleLine * static_cast<double>(i)) / height, size);
  return script;
}

std::string head(const Chart& chart, PlotFormat format, int height) {
  return "set encoding utf8\nset minussign\n" +
         fmt::format("set terminal {} noenhanced background '#ffffff'\n",
                     terminal(format, height)) +
         "set border 3 linecolor '#505860' linewidth 1.2\nset tics nomirror out scale 0.6 "
         "textcolor '#303840'\n"
         "set grid linecolor '#e4e6e9' linetype 1 linewidth 1, linecolor '#e4e6e9' linetype 1 "
         "linewidth 1\n"
         "set offsets graph 0, graph 0, graph 0.05, graph 0\n" +
         fmt::format("set lmargin at screen {}\nset rmargin at screen {:.5f}\n", kLeft,
                     right_end(chart)) +
         "set multiplot\n" + title_labels(chart, format, height);
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
      quoted(kHollowName));
}

/// One curve of the plot command; a title that stands in the legend already is left out there.
std::string curve_command(const Chart& chart,
                          const Panel& panel,
                          std::size_t index,
                          const std::string& data) {
  const Curve& curve = panel.curves[index];
  const std::size_t color = color_of(curve, index);
  int dash = curve.dashed ? 2 : kDashes[color / kColors.size() % kDashes.size()];
  const auto style = static_cast<std::size_t>(curve.style);
  if (!chart.runs.empty()) dash = kRunDashes[style % kRunDashes.size()];
  const bool marked = chart.runs.empty() && curve.x.size() <= kManyPoints;
  const std::string points = marked ? "linespoints pointtype 7 pointsize 0.35" : "lines";
  const bool keyed = chart.runs.empty() && !curve.title.empty();
  return fmt::format("{} with {} linewidth {} linecolor '{}' dashtype {} {}",
                     has_line(curve) ? "$" + data + " using 1:2" : "NaN", points, 2,
                     kColors[color % kColors.size()], dash,
                     keyed ? "title " + quoted(shortened(curve.title, kLongestName)) : "notitle");
}

/// Legend of several runs: a colour for each title, a line style for each run.
std::string run_legend(const Chart& chart, const Panel& panel, bool with_runs) {
  std::string commands;
  const auto entry = [&](const std::string& title, const char* color, int dash) {
    commands += fmt::format(", NaN with lines linewidth 2 linecolor '{}' dashtype {} title {}",
                            color, dash, quoted(shortened(title, kLongestName)));
  };
  std::vector<std::string> known;
  for (const Curve& curve : panel.curves) {
    if (curve.title.empty() || !has_points(curve)) continue;
    if (std::find(known.begin(), known.end(), curve.title) != known.end()) continue;
    known.push_back(curve.title);
    entry(curve.title, kColors[static_cast<std::size_t>(curve.color) % kColors.size()], 1);
  }
  for (std::size_t i = 0; with_runs && i < chart.runs.size(); ++i)
    entry(chart.runs[i], "#303840", kRunDashes[i % kRunDashes.size()]);
  return commands;
}

std::string y_range(const Panel& panel) {
  if (panel.from_zero) return "[0:*]";
  return panel.floor ? fmt::format("[{:g}<*:*]", *panel.floor) : "[*:*]";
}

std::string panel_script(const Chart& chart, std::size_t index, int height) {
  const Panel& panel = chart.panels[index];
  const double top =
      1 - (head_height(chart) + static_cast<double>(index) * (kPanelHeight + kPanelGap)) / height;
  const bool last = index + 1 == chart.panels.size();
  std::string script = fmt::format("set tmargin at screen {:.5f}\nset bmargin at screen {:.5f}\n",
                                   top, top - static_cast<double>(kPanelHeight) / height);
  script += fmt::format(
      "set key at screen {:.5f}, screen {:.5f} left top Left reverse vertical samplen 2.4 spacing "
      "1.25 textcolor '#303840'\n",
      right_end(chart) + 0.015, top);
  script += "set yrange " + y_range(panel) + "\n";
  script += last ? "set format x '%g'\n" : "set format x ''\n";
  script += "set ylabel " + quoted(panel.y_label) + " textcolor '#303840'\n";
  script += "set xlabel " + quoted(last ? chart.x_label : "") + " textcolor '#303840'\n";
  std::string commands;
  for (std::size_t i = 0; i < panel.curves.size(); ++i) {
    if (!has_points(panel.curves[i])) continue;
    const std::string name = fmt::format("panel{}curve{}", index, i);
    const Curve& curve = panel.curves[i];
    script += data_block(name, curve.x, curve.y);
    if (has_hollow(curve)) script += data_block(name + "hollow", curve.hollow_x, curve.hollow_y);
    commands += (commands.empty() ? "plot " : ", ") + curve_command(chart, panel, i, name) +
                hollow_command(curve, color_of(curve, i), name + "hollow");
  }
  if (!commands.empty() && !chart.runs.empty()) commands += run_legend(chart, panel, index == 0);
  if (!commands.empty()) commands += hollow_legend(panel);
  if (commands.empty()) commands = "set xrange [0:1]\nset yrange [0:1]\nplot NaN notitle";
  return script + commands + "\nunset label\n";
}

}  // namespace

const char* ending(PlotFormat format) {
  switch (format) {
    case PlotFormat::kPng:
      return "png";
    case PlotFormat::kSvg:
      return "svg";
    case PlotFormat::kPdf:
      return "pdf";
  }
  return "";
}

std::string gnuplot_script(const Chart& chart, PlotFormat format) {
  const int height = head_height(chart) + kFootHeight - kPanelGap +
                     (kPanelHeight + kPanelGap) * static_cast<int>(chart.panels.size());
  std::string script = head(chart, format, height);
  for (std::size_t i = 0; i < chart.panels.size(); ++i) script += panel_script(chart, i, height);
  return script + "unset multiplot\nunset output\n";
}

void plot(const Chart& chart, const std::filesystem::path& file, PlotFormat format) {
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  if (!std::filesystem::is_directory(folder))
    throw InputError(folder.string() + ": expected a folder to write " + file.filename().string() +
                     " into");
  const ProgramResult result = run_program({"gnuplot"}, gnuplot_script(chart, format));
  if (!result.started)
    throw PictureError("gnuplot is not installed: plots need it (Debian package gnuplot-nox)");
  if (result.exit_code != 0 || result.output.empty())
    throw PictureError(file.string() + ": gnuplot did not draw it: " + result.messages);
  write_output_file(file, result.output);
}

}  // namespace condyle
