#include "condyle/app/tell.h"

#include "condyle/control_characters.h"

namespace condyle {
namespace {

std::string shown(std::string_view text, std::string_view kept) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t size = utf8_size(text, at);
    const unsigned first = byte_at(text, at);
    const bool c1 = size == 2 && first == 0xc2U && byte_at(text, at + 1) < 0xa0U;
    const bool control = size == 1 && is_control(text[at]);
    if (const unsigned mark = turning_mark(text, at))
      out += fmt::format("\\u{:04x}", mark);
    else if (size == 0 || c1 || (control && kept.find(text[at]) == std::string_view::npos))
      out += fmt::format("\\u{:04x}", c1 ? byte_at(text, at + 1) : first);
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
