#pragma once

/// Puts together what a result file holds.

#include <vector>

#include <filesystem>

#include "equilibrium/pose_result.h"
#include "results/run_file.h"
#include "scene/fit_surfaces.h"

namespace condyle {

/// Scene, patches and the meshes of the bodies, with a sweep or, after a fit, with none.
[[nodiscard]] Run make_run(const Scene& scene,
                           const std::vector<FittedSurface>& surfaces,
                           SweepResult sweep = {});

/// Throws InputError where the file to write is the scene or one of its meshes.
void refuse_to_overwrite_inputs(const std::filesystem::path& output, const Scene& scene);

}  // namespace condyle
