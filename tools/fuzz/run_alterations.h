#pragma once

/// A result of tests/fuzz/run with groups, datasets and attributes taken away, renamed, or given other
/// types, shapes and values, through HDF5 itself: a file that is whole as such and wrong as a result.

#include <string>

#include "fuzz/choices.h"

namespace condyle::fuzz {

/// The bytes of the file. Throws std::runtime_error where there is no result to alter.
[[nodiscard]] std::string altered_run(Choices& choices);

}  // namespace condyle::fuzz
