#include "condyle/pictures/gnuplot_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "condyle/input_error.h"
#include "condyle/pictures/fitted_words.h"
#include "condyle/pictures/picture_error.h"
#include "condyle/pictures/run_program.h"
#include "condyle/results/output_file.h"

namespace condyle {
namespace {

constexpr double kLeastTitleSize = 11, kPdfTitleSize = 8.5;  // [point]
constexpr double kPdfInch = 7.0 / kPageWidth;  // of a pixel: 7 inch are two columns of a journal

constexpr std::size_t kLongestTitle = 400;  // letters: more are on no line

double widest(const std::vector<std::string>& lines, double size) {
  double width = 0;
  for (const std::string& line : lines) width = std::max(width, words_width(line, size, true));
  return width;
}

}  // namespace

std::string quoted_words(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20)
      result += ' ';
    else if (std::string_view("\"\\'`@$").find(c) != std::string_view::npos)
      result += fmt::format("\\{:03o}", byte);
    else
      result += c;
  }
  return result + '"';
}

std::string terminal(PlotFormat format, int width, int height) {
  switch (format) {
    case PlotFormat::kPng:
      return fmt::format("pngcairo size {},{} font 'DejaVu Sans,13'", width, height);
    case PlotFormat::kSvg:
      return fmt::format("svg size {},{} font 'DejaVu Sans,13'", width, height);
    case PlotFormat::kPdf:
      // The same page, set smaller: letters of 7 points on a width of two columns.
      return fmt::format(
          "pdfcairo size {:.4g}in,{:.4f}in font 'DejaVu Sans,7' fontscale 0.75 pointscale 0.6",
          kPdfInch * width, kPdfInch * height);
  }
  return "";
}

double letter_size(PlotFormat format, double size) {
  return format == PlotFormat::kPdf ? kPdfTitleSize * size / kTitleSize : size;
}

std::string plot_style(PlotFormat format, int width, int height) {
  return "set encoding utf8\nset minussign\n" +
         fmt::format("set terminal {} noenhanced background '#ffffff'\n",
                     terminal(format, width, height)) +
         "set border 3 linecolor '#505860' linewidth 1.2\nset tics nomirror out scale 0.6 "
         "textcolor '#303840'\n"
         "set grid linecolor '#e4e6e9' linetype 1 linewidth 1, linecolor '#e4e6e9' linetype 1 "
         "linewidth 1\n"
         "set offsets graph 0, graph 0, graph 0.05, graph 0\n";
}

std::string data_block(const std::string& name, const std::string& lines) {
  return "$" + name + " << END_OF_DATA\n" + lines + "END_OF_DATA\n";
}

std::vector<std::size_t> lone_points(const std::vector<double>& x, const std::vector<double>& y) {
  const std::size_t count = std::min(x.size(), y.size());
  const auto is_known = [&](std::size_t i) {
    return i < count && std::isfinite(x[i]) && std::isfinite(y[i]);
  };
  std::vector<std::size_t> alone;
  for (std::size_t i = 0; i < count; ++i)
    if (is_known(i) && (i == 0 || !is_known(i - 1)) && !is_known(i + 1)) alone.push_back(i);
  return alone;
}

Title page_title(const std::string& title, const std::string& what, double room) {
  if (title.empty()) return {{what}};
  const std::string first = shortened(title, kLongestTitle);
  Title one{{what.empty() ? first : first + ": " + what}};
  if (widest(one.lines, one.size) <= room) return one;
  Title two{what.empty() ? std::vector<std::string>{first}
                         : std::vector<std::string>{first + ":", what}};
  while (two.size > kLeastTitleSize && widest(two.lines, two.size) > room) two.size -= 0.5;
  for (std::string& line : two.lines)
    line = cut_words(line, room,
                     [&](const std::string& words) { return words_width(words, two.size, true); });
  return two;
}

int head_height(const Title& title) {
  return kHeadHeight + kTitleLine * (static_cast<int>(title.lines.size()) - 1);
}

std::string title_labels(const Title& title, double left, PlotFormat format, int height) {
  std::string script;
  for (std::size_t i = 0; i < title.lines.size(); ++i)
    script += fmt::format(
        "set label {} {} at screen {}, screen {:.5f} font 'DejaVu Sans Bold,{:g}' textcolor "
        "'#262c34'\n",
        i + 1, quoted_words(title.lines[i]), left,
        1 - (0.45 * kHeadHeight + kTitleLine * static_cast<double>(i)) / height,
        letter_size(format, title.size));
  return script;
}

constexpr const char* kNoGnuplot =
    "gnuplot is not installed: plots need it (Debian package gnuplot-nox)";

void expect_gnuplot() { expect_started(run_program({"gnuplot", "--version"}, ""), kNoGnuplot); }

std::string drawn(const std::string& script, const std::string& name) {
  // Nobody's settings in ~/.gnuplot.
  ProgramResult result = run_program({"gnuplot", "--default-settings"}, script);
  expect_started(result, kNoGnuplot);
  if (result.exit_code != 0 || result.output.empty())
    throw PictureError(name + ": gnuplot did not draw it: " + result.messages);
  return std::move(result.output);
}

void draw_script(const std::string& script, const std::filesystem::path& file) {
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  if (!std::filesystem::is_directory(folder))
    throw InputError(folder.string() + ": expected a folder to write " + file.filename().string() +
                     " into");
  write_output_file(file, drawn(script, file.string()));
}

}  // namespace condyle
