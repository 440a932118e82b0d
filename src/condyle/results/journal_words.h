#pragma once

/// Words of a journal's line: numbers with the fewest digits that give back the same bits, one space
/// before each, and the hash at its end that tells whether the line is whole.

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <string>
#include <string_view>
#include <system_error>

#include "condyle/results/run_identity.h"

namespace condyle {

template <typename T>
void put_word(std::string& out, T number) {
  char text[32];
  const std::to_chars_result end = std::to_chars(text, text + sizeof text, number);
  out += ' ';
  out.append(text, end.ptr);
}

inline void put_words(std::string& out, const double* numbers, std::ptrdiff_t count) {
  for (std::ptrdiff_t i = 0; i < count; ++i) put_word(out, numbers[i]);
}

/// Takes numbers off the front of a line; `ok` tells whether each was there.
struct WordTaker {
  std::string_view rest;
  bool ok = true;

  template <typename T>
  T number() {
    T value{};
    if (!rest.empty() && rest.front() == ' ') rest.remove_prefix(1);
    const std::from_chars_result end =
        std::from_chars(rest.data(), rest.data() + rest.size(), value);
    ok &= end.ec == std::errc();
    rest.remove_prefix(static_cast<std::size_t>(end.ptr - rest.data()));
    return value;
  }
  void numbers(double* values, std::ptrdiff_t count) {
    for (std::ptrdiff_t i = 0; i < count; ++i) values[i] = number<double>();
  }
  /// A number below `limit`, else 0 and not ok.
  std::size_t index(std::size_t limit) {
    const auto value = number<std::size_t>();
    ok &= value < limit;
    return ok ? value : 0;
  }
};

/// Cuts the last number off a line.
template <typename Number>
bool take_last_word(std::string_view& line, Number& number) {
  const std::size_t at = line.rfind(' ');
  if (at == std::string_view::npos) return false;
  WordTaker take{line.substr(at)};
  number = take.number<Number>();
  line = line.substr(0, at);
  return take.ok && take.rest.empty();
}

/// Ends the line that begins at `begin` of `out`, with its hash.
inline void seal_line(std::size_t begin, std::string& out) {
  std::replace(out.begin() + static_cast<std::ptrdiff_t>(begin), out.end(), '\n', ' ');
  put_word(out, hash_bytes(std::string_view(out).substr(begin)));
  out += '\n';
}

/// Cuts the hash off the end of a line; false where it does not fit what stands before it.
[[nodiscard]] inline bool take_seal(std::string_view& line) {
  std::uint64_t hash = 0;
  return take_last_word(line, hash) && hash == hash_bytes(line);
}

}  // namespace condyle
