#pragma once

/// The exact-surface knee of the tests with bicubic patches in place of its four surfaces: the same
/// mechanics, the evaluation that a real knee costs.

#include "equilibrium/model.h"
#include "support/quadric_knee.h"

namespace condyle::benchmarks {

[[nodiscard]] Model patch_knee();

}  // namespace condyle::benchmarks
