#pragma once

/// How a number is spread: from a point of the unit interval to a change of that number.

#include <array>

namespace condyle {

struct Spread {
  enum class Kind {
    kNormal,   ///< mean 0, deviation sd, cut at the bounds
    kUniform,  ///< between the bounds
    kBits      ///< the point itself: a seed of something random
  };
  Kind kind = Kind::kNormal;
  double sd = 1;  ///< kNormal, > 0: of the normal distribution before it is cut
  std::array<double, 2> bounds = {-1e300, 1e300};  ///< [0] <= [1]
};

/// The inverse of its distribution function at 0 < u < 1 (Boost.Math). Never beyond the bounds, and
/// accurate in both tails. Where the bounds leave nothing but what lies beyond 37 sd, all of it stands
/// at the bound next to the mean.
[[nodiscard]] double quantile(const Spread& spread, double u);

}  // namespace condyle
