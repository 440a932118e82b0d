#pragma once

/// The engine's Newton on exactly one closed contact in each compartment, without its search: with
/// the surfaces and springs of the reference model that is the reference model, solved by the
/// other solver. Each pose starts at the reference's and is solved anew; what comes out is the
/// engine's own.

#include <vector>

#include "condyle/equilibrium/pose_result.h"
#include "condyle/scene/fitted_surface.h"
#include "condyle/scene/scene.h"

namespace condyle {

[[nodiscard]] SweepResult sweep_one_contact_each(const Scene& scene,
                                                 const std::vector<FittedSurface>& surfaces,
                                                 const SweepResult& reference);

}  // namespace condyle
