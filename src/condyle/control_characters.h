#pragma once

/// Characters that are no text: in a name they could end a line, or be a command to a terminal.

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace condyle {

[[nodiscard]] constexpr bool is_control(char c) {
  return static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
}

[[nodiscard]] inline bool has_control_characters(std::string_view text) {
  return std::any_of(text.begin(), text.end(), is_control);
}

/// 0 beyond the end.
[[nodiscard]] constexpr unsigned byte_at(std::string_view text, std::size_t at) {
  return at < text.size() ? static_cast<unsigned char>(text[at]) : 0U;
}

/// Bytes of the letter of UTF-8 that begins here; 0 where none does.
[[nodiscard]] constexpr std::size_t utf8_size(std::string_view text, std::size_t at) {
  const unsigned first = byte_at(text, at);
  const std::size_t size = first < 0x80U                     ? 1
                           : first >= 0xc2U && first < 0xe0U ? 2
                           : first >= 0xe0U && first < 0xf0U ? 3
                           : first >= 0xf0U && first < 0xf5U ? 4
                                                             : 0;
  const unsigned second = byte_at(text, at + 1);
  // Longer than need be, half of a pair of UTF-16, beyond the last letter.
  if ((first == 0xe0U && second < 0xa0U) || (first == 0xedU && second > 0x9fU) ||
      (first == 0xf0U && second < 0x90U) || (first == 0xf4U && second > 0x8fU))
    return 0;
  for (std::size_t i = 1; i < size; ++i)
    if ((byte_at(text, at + i) & 0xc0U) != 0x80U) return 0;
  return size;
}

/// The code point of the letter that begins at a place where it turns the direction of what follows
/// (U+202A to U+202E, U+2066 to U+2069) or breaks the line (U+2028, U+2029), in UTF-8 of three
/// bytes; 0 for any other. Unseen itself, it lets a name look like another one.
[[nodiscard]] constexpr unsigned turning_mark(std::string_view text, std::size_t at) {
  if (at + 2 >= text.size() || static_cast<unsigned char>(text[at]) != 0xe2) return 0;
  const unsigned second = static_cast<unsigned char>(text[at + 1]),
                 third = static_cast<unsigned char>(text[at + 2]);
  const bool turns = (second == 0x80 && third >= 0xa8 && third <= 0xae) ||
                     (second == 0x81 && third >= 0xa6 && third <= 0xa9);
  return turns ? 0x2000U + ((second & 0x3fU) << 6U) + (third & 0x3fU) : 0;
}

}  // namespace condyle
