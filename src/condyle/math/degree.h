#pragma once

#include <numbers>

namespace condyle {

/// One degree [rad].
inline constexpr double kDegree = std::numbers::pi / 180;

}  // namespace condyle
