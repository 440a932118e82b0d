#pragma once

/// The doors of the program: readers of what strangers send. Each is a function of bytes, called by
/// libFuzzer (tools/fuzz.sh) with bytes that it makes up, and by tests with those of tests/fuzz.
///
/// A door may refuse what it is given, by InputError in one line; whatever else leaves it is a
/// defect. What it accepts is used as the program would: written, read again, compared.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace condyle::fuzz {

using Bytes = std::span<const std::uint8_t>;

struct Door {
  std::string name;     ///< of its program, condyle_fuzz_NAME, and of its folder in tests/fuzz
  void (*open)(Bytes);  ///< throws nothing but on a defect
  std::size_t largest;  ///< bytes that are worth trying
};

[[nodiscard]] const std::vector<Door>& doors();

/// Throws std::out_of_range where there is none of that name.
[[nodiscard]] const Door& door(const std::string& name);

}  // namespace condyle::fuzz
