#pragma once

/// Who may read a file that takes the place of another, or lies beside it: results hold meshes of patients.

#include <filesystem>

namespace condyle {

/// The permissions of `of` where that is a plain file, and `at_least` those; as they are where it is none, or they
/// cannot be set.
void take_mode(int descriptor, const std::filesystem::path& of, unsigned at_least = 0);

}  // namespace condyle
