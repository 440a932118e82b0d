#pragma once

#include <limits>

namespace condyle {

/// In place of what a dataset has no number for.
inline constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

}  // namespace condyle
