#pragma once

/// Characters that are no text: in a name they could end a line, or be a command to a terminal.

#include <algorithm>
#include <string_view>

namespace condyle {

[[nodiscard]] constexpr bool is_control(char c) {
  return static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
}

[[nodiscard]] inline bool has_control_characters(std::string_view text) {
  return std::any_of(text.begin(), text.end(), is_control);
}

}  // namespace condyle
