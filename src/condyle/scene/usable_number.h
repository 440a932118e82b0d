#pragma once

/// Which numbers a scene, and options that stand for some of its, may hold.

#include <cmath>

namespace condyle {

inline constexpr double kGreatestNumber = 1e100;

/// Finite, and so are its square and its product with any unit.
[[nodiscard]] inline bool is_usable(double number) { return std::abs(number) < kGreatestNumber; }

/// Within a turn either way, and what rounding adds to it; beyond that the unit is mistaken [rad].
[[nodiscard]] inline bool is_usable_angle(double angle) {
  return std::abs(angle) < 2 * M_PI * (1 + 1e-12);
}

}  // namespace condyle
