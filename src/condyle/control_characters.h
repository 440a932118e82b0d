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
