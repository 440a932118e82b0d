#pragma once

/// What the program writes for people, on the standard output or on the standard error. Names, titles and reasons come
/// from files: a control character in them would command the terminal.

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <string_view>
#include <utility>

namespace condyle {

/// Control characters (C0, DEL, C1), marks that turn the direction of text and bytes that are no UTF-8 as "\u001b", which
/// JSON and TOML read, too. Line breaks and tabs stay.
[[nodiscard]] std::string printable(std::string_view text);
/// The same on one line: of line breaks and tabs, too.
[[nodiscard]] std::string printable_line(std::string_view text);

template <class... Values>
void tell(std::FILE* stream, fmt::format_string<Values...> format, Values&&... values) {
  const std::string text = printable(fmt::format(format, std::forward<Values>(values)...));
  std::fwrite(text.data(), 1, text.size(), stream);
}

template <class... Values>
void tell(fmt::format_string<Values...> format, Values&&... values) {
  tell(stdout, format, std::forward<Values>(values)...);
}

}  // namespace condyle
