#pragma once

/// Words that have to fit into a room: their width, and what is left of them.

#include <cstddef>
#include <functional>
#include <string>

namespace condyle {

inline constexpr std::size_t kMostLetters =
    2000;  ///< of a text that is measured: more are on no page

/// Letters of UTF-8.
[[nodiscard]] std::size_t letters(const std::string& text);
/// At most `most` letters of UTF-8, with an ellipsis where some are left out.
[[nodiscard]] std::string shortened(const std::string& text, std::size_t most);

/// The text or, where that is wider than `room`, as many of its first letters as fit with an ellipsis, at least one.
/// `width` does not fall with letters that are added.
[[nodiscard]] std::string cut_words(const std::string& text,
                                    double room,
                                    const std::function<double(const std::string&)>& width);

inline constexpr double kPixelPerPoint = 4.0 / 3;  ///< of gnuplot's PNG and SVG
/// Width of words in letters of DejaVu Sans of that size [point] on a page of PNG or SVG [pixel].
[[nodiscard]] double words_width(const std::string& text, double size, bool bold = false);

}  // namespace condyle
