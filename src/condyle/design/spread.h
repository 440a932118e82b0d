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
  double sd = 1;
  std::array<double, 2> bounds = {-1e300, 1e300};
};

/// The inverse of its distribution function at 0 < u < 1 (Boost.Math).
[[nodiscard]] double quantile(const Spread& spread, double u);

}  // namespace condyle
