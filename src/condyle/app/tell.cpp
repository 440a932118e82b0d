#include "condyle/app/tell.h"

#include "condyle/control_characters.h"

namespace condyle {
namespace {

unsigned byte(std::string_view text, std::size_t at) {
  return at < text.size() ? static_cast<unsigned char>(text[at]) : 0U;
}

/// Bytes of the letter of UTF-8 that begins here; 0 where none does.
std::size_t letter_size(std::string_view text, std::size_t at) {
  const unsigned first = byte(text, at);
  const std::size_t size = first < 0x80U                     ? 1
                           : first >= 0xc2U && first < 0xe0U ? 2
                           : first >= 0xe0U && first < 0xf0U ? 3
                           : first >= 0xf0U && first < 0xf5U ? 4
                                                             : 0;
  for (std::size_t i = 1; i < size; ++i)
    if ((byte(text, at + i) & 0xc0U) != 0x80U) return 0;
  return size;
}

std::string shown(std::string_view text, std::string_view kept) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t size = letter_size(text, at);
    const unsigned first = byte(text, at);
    const bool c1 = size == 2 && first == 0xc2U && byte(text, at + 1) < 0xa0U;
    const bool control = size == 1 && is_control(text[at]);
    if (const unsigned mark = turning_mark(text, at))
      out += fmt::format("\\u{:04x}", mark);
    else if (size == 0 || c1 || (control && kept.find(text[at]) == std::string_view::npos))
      out += fmt::format("\\u{:04x}", c1 ? byte(text, at + 1) : first);
    else
      out += text.substr(at, size);
    at += size == 0 ? 1 : size;
  }
  return out;
}

}  // namespace

std::string printable(std::string_view text) { return shown(text, "\n\t"); }

std::string printable_line(std::string_view text) { return shown(text, ""); }

}  // namespace condyle
