#pragma once

/// The sweep of a scene of the phantom on its exact surfaces, no fit between.

#include <string>
#include <vector>

#include "condyle/equilibrium/pose_result.h"
#include "condyle/specimen/fit_surfaces.h"
#include "phantom/phantom_parameters.h"

namespace condyle::phantom {

/// One for each surface of a scene of the phantom: the compartment of the bone that it is fitted
/// to.
[[nodiscard]] std::vector<FittedSurface> exact_surfaces(
    const Scene& scene, const PhantomParameters& knee = kShippedPhantom);

/// Rows of a table: flexion, rotations [deg], contact places along x of the tibia [mm], forces [N].
/// A pose that is missing or did not converge is a row with nan.
[[nodiscard]] std::string motion_table(const Scene& scene,
                                       const SweepResult& sweep,
                                       const std::vector<double>& flexions_deg);

}  // namespace condyle::phantom
