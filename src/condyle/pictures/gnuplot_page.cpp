#include "condyle/pictures/gnuplot_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "condyle/input_error.h"
#include "condyle/pictures/picture_error.h"
#include "condyle/pictures/run_program.h"
#include "condyle/pictures/text.h"
#include "condyle/results/output_file.h"

namespace condyle {
namespace {

constexpr double kLeastTitleSize = 11, kPdfTitleSize = 8.5;  // [point]
constexpr int kTitleLine = 28;                               // [pixel]
constexpr double kPdfInch = 7.0 / kPageWidth;  // of a pixel: 7 inch are two columns of a journal

double widest(const std::vector<std::string>& lines, double size) {
  Font font(true);
  double width = 0;
  for (const std::string& line : lines)
    width = std::max(width, static_cast<double>(font.width(
                                line, static_cast<int>(std::ceil(kPixelPerPoint * size)))));
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

Title page_title(const std::string& title, const std::string& what, double room) {
  if (title.empty()) return {{what}};
  Title one{{title + ": " + what}};
  if (widest(one.lines, one.size) <= room) return one;
  Title two{{title + ":", what}};
  while (two.size > kLeastTitleSize && widest(two.lines, two.size) > room) two.size -= 0.5;
  for (std::string& line : two.lines) {
    for (std::size_t n = letters(line); n > 1 && widest({line}, two.size) > room; --n)
      line = shortened(line, n - 1);
  }
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

void draw_script(const std::string& script, const std::filesystem::path& file) {
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  if (!std::filesystem::is_directory(folder))
    throw InputError(folder.string() + ": expected a folder to write " + file.filename().string() +
                     " into");
  // Nobody's settings in ~/.gnuplot.
  const ProgramResult result = run_program({"gnuplot", "--default-settings"}, script);
  if (!result.started)
    throw PictureError("gnuplot is not installed: plots need it (Debian package gnuplot-nox)");
  if (result.exit_code != 0 || result.output.empty())
    throw PictureError(file.string() + ": gnuplot did not draw it: " + result.messages);
  write_output_file(file, result.output);
}

}  // namespace condyle
