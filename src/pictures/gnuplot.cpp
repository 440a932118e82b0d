#include "pictures/gnuplot.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "input_error.h"
#include "pictures/picture_error.h"
#include "pictures/run_program.h"

namespace condyle {
namespace {

constexpr int kWidth = 1200, kPanelHeight = 400, kPanelGap = 34, kHeadHeight = 80,
              kFootHeight = 84;  // [pixel]

/// Okabe and Ito's colours for every kind of sight; lines beyond their number are dashed.
constexpr std::array<const char*, 8> kColors = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                                "#E69F00", "#56B4E9", "#000000", "#8C6BB1"};
constexpr std::array<int, 4> kDashes = {1, 2, 4, 5};

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

std::string data_block(const std::string& name, const Curve& curve) {
  std::string block = "$" + name + " << END_OF_DATA\n";
  for (std::size_t i = 0; i < curve.x.size() && i < curve.y.size(); ++i) {
    const bool known = std::isfinite(curve.x[i]) && std::isfinite(curve.y[i]);
    block += known ? fmt::format("{:.9g} {:.9g}\n", curve.x[i], curve.y[i]) : "\n";
  }
  return block + "END_OF_DATA\n";
}

bool has_points(const Curve& curve) {
  for (std::size_t i = 0; i < curve.x.size() && i < curve.y.size(); ++i) {
    if (std::isfinite(curve.x[i]) && std::isfinite(curve.y[i])) return true;
  }
  return false;
}

std::string head(const Chart& chart,
                 const std::filesystem::path& file,
                 PlotFormat format,
                 int height) {
  const char* terminal = format == PlotFormat::kPng ? "pngcairo" : "svg";
  return "set encoding utf8\n" +
         fmt::format(
             "set terminal {} size {},{} font 'DejaVu Sans,13' noenhanced background '#ffffff'\n",
             terminal, kWidth, height) +
         "set output " + quoted(file.string()) + "\n" +
         "set border 3 linecolor '#505860' linewidth 1.2\nset tics nomirror out scale 0.6 "
         "textcolor '#303840'\n"
         "set grid linecolor '#e4e6e9' linetype 1 linewidth 1, linecolor '#e4e6e9' linetype 1 "
         "linewidth 1\n"
         "set offsets graph 0, graph 0, graph 0.05, graph 0\n"
         "set lmargin at screen 0.09\nset rmargin at screen 0.80\n" +
         fmt::format(
             "set multiplot\nset label 1 {} at screen 0.09, screen {:.5f} font 'DejaVu Sans "
             "Bold,16' textcolor '#262c34'\n",
             quoted(chart.title), 1 - 0.45 * kHeadHeight / height);
}

std::string panel_script(const Chart& chart, std::size_t index, int height) {
  const Panel& panel = chart.panels[index];
  const double top =
      1 - (kHeadHeight + static_cast<double>(index) * (kPanelHeight + kPanelGap)) / height;
  const bool last = index + 1 == chart.panels.size();
  std::string script = fmt::format("set tmargin at screen {:.5f}\nset bmargin at screen {:.5f}\n",
                                   top, top - static_cast<double>(kPanelHeight) / height);
  script += fmt::format(
      "set key at screen 0.82, screen {:.5f} left top Left reverse vertical samplen 2 spacing 1.25 "
      "textcolor '#303840'\n",
      top);
  script += panel.from_zero ? "set yrange [0:*]\n" : "set yrange [*:*]\n";
  script += last ? "set format x '%g'\n" : "set format x ''\n";
  script += "set ylabel " + quoted(panel.y_label) + " textcolor '#303840'\n";
  script += "set xlabel " + quoted(last ? chart.x_label : "") + " textcolor '#303840'\n";
  std::string commands;
  for (std::size_t i = 0; i < panel.curves.size(); ++i) {
    if (!has_points(panel.curves[i])) continue;
    const Curve& curve = panel.curves[i];
    const std::size_t color = curve.color < 0 ? i : static_cast<std::size_t>(curve.color);
    const int dash = curve.dashed ? 2 : kDashes[color / kColors.size() % kDashes.size()];
    const std::string name = fmt::format("panel{}curve{}", index, i);
    script += data_block(name, curve);
    commands += fmt::format(
        "{}${} using 1:2 with linespoints linewidth 2 linecolor '{}' dashtype {} pointtype 7 "
        "pointsize 0.35 title {}",
        commands.empty() ? "plot " : ", ", name, kColors[color % kColors.size()], dash,
        quoted(curve.title));
  }
  if (commands.empty()) commands = "set xrange [0:1]\nset yrange [0:1]\nplot NaN notitle";
  return script + commands + "\nunset label 1\n";
}

}  // namespace

std::string gnuplot_script(const Chart& chart,
                           const std::filesystem::path& file,
                           PlotFormat format) {
  const int height = kHeadHeight + kFootHeight - kPanelGap +
                     (kPanelHeight + kPanelGap) * static_cast<int>(chart.panels.size());
  std::string script = head(chart, file, format, height);
  for (std::size_t i = 0; i < chart.panels.size(); ++i) script += panel_script(chart, i, height);
  return script + "unset multiplot\nunset output\n";
}

void plot(const Chart& chart, const std::filesystem::path& file, PlotFormat format) {
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  if (!std::filesystem::is_directory(folder))
    throw InputError(folder.string() + ": expected a folder to write " + file.filename().string() +
                     " into");
  const std::filesystem::path part = file.string() + ".part";
  const ProgramResult result = run_program({"gnuplot"}, gnuplot_script(chart, part, format));
  std::error_code error;
  const bool empty = std::filesystem::file_size(part, error) == 0 || error;
  if (!result.started)
    throw PictureError("gnuplot is not installed: plots need it (Debian package gnuplot-nox)");
  if (result.exit_code != 0 || empty) {
    std::filesystem::remove(part, error);
    throw PictureError(file.string() + ": gnuplot did not write it: " + result.messages);
  }
  std::filesystem::rename(part, file, error);
  if (error) throw InputError(file.string() + ": cannot write: " + error.message());
}

}  // namespace condyle
