#pragma once

/// The doors of the program: readers of what strangers send. Each is a function of bytes, called by
/// libFuzzer (tools/fuzz.sh) with bytes that it makes up, and by tests with those of tests/fuzz.
///
/// A door may refuse what it is given, by InputError in one line; whatever else leaves it is a
/// defect. What it accepts is used as the program would: written, read again, compared.

#include <string>
#include <vector>

#include "fuzz/door.h"

namespace condyle::fuzz {

[[nodiscard]] const std::vector<Door>& doors();

/// Throws std::out_of_range where there is none of that name.
[[nodiscard]] const Door& door(const std::string& name);

}  // namespace condyle::fuzz
