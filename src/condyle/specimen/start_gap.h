#pragma once

/// How far the surfaces of a contact lie from each other before anything is solved.

#include <vector>

#include "condyle/scene/fitted_surface.h"
#include "condyle/scene/scene.h"

namespace condyle {

/// Smallest gap of a contact at the start pose [mm], negative where the bodies overlap; infinite
/// where the surfaces do not face each other, or neither has bounds. Refined until it falls by less than 1e-9 mm, from both sides.
[[nodiscard]] double start_gap(const Scene& scene,
                               const std::vector<FittedSurface>& surfaces,
                               const ContactDescription& contact);

}  // namespace condyle
