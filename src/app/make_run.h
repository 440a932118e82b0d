#pragma once

/// Puts together what a result file holds.

#include <vector>

#include "equilibrium/pose_result.h"
#include "results/run_file.h"
#include "scene/fit_surfaces.h"

namespace condyle {

/// Scene, patches and the meshes of the bodies, with a sweep or, after a fit, with none.
[[nodiscard]] Run make_run(const Scene& scene,
                           const std::vector<FittedSurface>& surfaces,
                           SweepResult sweep = {});

}  // namespace condyle
