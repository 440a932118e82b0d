#pragma once

/// The exact-surface knee of the tests with bicubic patches in place of its four surfaces: the same
/// mechanics, the evaluation that a real knee costs.

#include <array>

#include "condyle/equilibrium/model.h"
#include "support/quadric_knee.h"

namespace condyle::benchmarks {

/// `control_points` of each patch, along its two directions.
[[nodiscard]] Model patch_knee(const std::array<int, 2>& control_points = {16, 12});

}  // namespace condyle::benchmarks
