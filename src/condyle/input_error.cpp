#include "condyle/input_error.h"

#include "condyle/control_characters.h"

namespace condyle {

std::string one_line(std::string text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    if (is_control(text[i])) text[i] = c == '\n' || c == '\r' || c == '\t' ? ' ' : '?';
    const auto next = i + 1 < text.size() ? static_cast<unsigned char>(text[i + 1]) : 0;
    // U+0080 to U+009F in UTF-8: control characters too.
    if (c == 0xC2 && next >= 0x80 && next < 0xA0) text.replace(i, 2, "?");
  }
  return text;
}

}  // namespace condyle
