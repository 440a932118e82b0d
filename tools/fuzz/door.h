#pragma once

/// One door of the program (doors.h): a function of bytes.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace condyle::fuzz {

using Bytes = std::span<const std::uint8_t>;

struct Door {
  std::string name;     ///< of its program, condyle_fuzz_NAME, and of its folder in tests/fuzz
  void (*open)(Bytes);  ///< throws nothing but on a defect
  std::size_t largest;  ///< bytes that are worth trying
};

}  // namespace condyle::fuzz
