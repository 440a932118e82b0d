#pragma once

#include <limits>

namespace condyle {

/// In place of what there is no number for: in results, columns and datasets.
inline constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

}  // namespace condyle
