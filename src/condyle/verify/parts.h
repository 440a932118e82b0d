#pragma once

#include <algorithm>
#include <cmath>

namespace condyle::verification {

/// How many parts something is looked at in: as many as wanted between the fewest and the most. What is no
/// number comes to the fewest, what is beyond all integers to the most: a damaged run holds anything.
[[nodiscard]] inline int parts_of(double wanted, int fewest, int most) {
  const double at_least = std::max(static_cast<double>(fewest), wanted);
  return static_cast<int>(std::ceil(std::min(static_cast<double>(most), at_least)));
}

}  // namespace condyle::verification
