#pragma once

#include <limits>

namespace condyle {

inline constexpr double kMissing =
    std::numeric_limits<double>::quiet_NaN();  ///< of a row that did not succeed

}  // namespace condyle
