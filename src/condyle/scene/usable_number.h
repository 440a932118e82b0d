#pragma once

/// Which numbers a scene, and options that stand for some of its, may hold.

#include <cmath>

namespace condyle {

inline constexpr double kGreatestNumber = 1e100;

/// Finite, and so are its square and its product with any unit.
[[nodiscard]] inline bool is_usable(double number) { return std::abs(number) < kGreatestNumber; }

}  // namespace condyle
