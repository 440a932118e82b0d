#pragma once

/// What all pages of plots share: size, colours, title, terminal, and the way through gnuplot. The
/// origin of pixels is the upper left corner of the page.

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "condyle/pictures/plot_format.h"

namespace condyle {

inline constexpr int kPageWidth = 1200, kHeadHeight = 80;  // [pixel]
inline constexpr double kTitleSize = 16;                   // [point]
inline constexpr int kTitleLine = 28;                      // [pixel]

/// Okabe and Ito's colours for every kind of sight; lines beyond their number are dashed.
inline constexpr std::array<const char*, 8> kColors = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                                       "#E69F00", "#56B4E9", "#000000", "#8C6BB1"};

/// In double quotes, with what gnuplot could take for an end, a command or a macro as octal numbers: within single quotes
/// a text that begins with one ends at once (5.4).
[[nodiscard]] std::string quoted_words(const std::string& text);

/// Of a page of that size; in a PDF kPageWidth is the width of two columns of a journal.
[[nodiscard]] std::string terminal(PlotFormat format, int width, int height);
/// Letters of that size on a page of pixels [point], as the format has them.
[[nodiscard]] double letter_size(PlotFormat format, double size);
/// Borders, tics, grid, and what all panels of a page begin with.
[[nodiscard]] std::string plot_style(PlotFormat format, int width, int height);

/// Lines of numbers under a name, for `$NAME` in a command.
[[nodiscard]] std::string data_block(const std::string& name, const std::string& lines);
/// Indices of the points without a neighbour on either side, of which a line shows nothing. NaN, or no number: a gap.
[[nodiscard]] std::vector<std::size_t> lone_points(const std::vector<double>& x,
                                                   const std::vector<double>& y);

/// The title in one line or, where that is too long, in two, smaller where it has to be, and cut.
struct Title {
  std::vector<std::string> lines;
  double size = kTitleSize;  ///< [point]
};
/// `room` for it [pixel].
[[nodiscard]] Title page_title(const std::string& title, const std::string& what, double room);
/// Height above the panels [pixel].
[[nodiscard]] int head_height(const Title& title);
/// Labels from number 1; `left` of the page [-].
[[nodiscard]] std::string title_labels(const Title& title,
                                       double left,
                                       PlotFormat format,
                                       int height);

/// Throws PictureError where gnuplot cannot be started.
void expect_gnuplot();
/// What gnuplot draws by the script. Throws PictureError, with `name`, where gnuplot is missing or refuses.
[[nodiscard]] std::string drawn(const std::string& script, const std::string& name);
/// Writes that; never leaves a half-written file. Throws InputError, too, where the folder does not exist.
void draw_script(const std::string& script, const std::filesystem::path& file);

}  // namespace condyle
