#pragma once

/// What a door may do with what it does not take: refuse it in one line.

#include <algorithm>
#include <stdexcept>
#include <string>

#include "condyle/input_error.h"
#include "fuzz/doors.h"

namespace condyle::fuzz {

[[nodiscard]] inline std::string text_of(Bytes bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Throws std::logic_error for a text that a terminal would not show as one line.
inline void expect_one_line(const std::string& text) {
  const auto control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; };
  if (text.empty() || std::any_of(text.begin(), text.end(), control))
    throw std::logic_error("is not one line: " + text);
}

/// Calls `use`; false where it refused, which must be an InputError of one line.
template <typename Use>
bool taken(const Use& use) {
  try {
    use();
    return true;
  } catch (const InputError& refused) {
    expect_one_line(refused.what());
    return false;
  }
}

}  // namespace condyle::fuzz
