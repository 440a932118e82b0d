#pragma once

#include <filesystem>

namespace condyle::test {

/// No part of the project: tests that need them skip where they are absent.
inline const std::filesystem::path kSpecimens =
    std::filesystem::path(CONDYLE_SOURCE_DIR) / "../shared/specimens";

}  // namespace condyle::test
