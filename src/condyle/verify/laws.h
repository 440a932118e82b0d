#pragma once

/// The force laws of docs/elements.md once more, from the parameters of the scene.

#include "condyle/scene/scene.h"

namespace condyle::verification {

/// Tension at a length [N], [mm].
[[nodiscard]] double force_at(const ForceLaw& law, double length);

/// Change of force with length, by differences [N/mm].
[[nodiscard]] double slope_at(const ForceLaw& law, double length);

/// ∫ f dL between two lengths that lie close together [N mm].
[[nodiscard]] double work_between(const ForceLaw& law, double from, double to);

}  // namespace condyle::verification
