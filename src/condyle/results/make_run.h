#pragma once

/// What a result file holds before anything is computed.

#include <filesystem>
#include <vector>

#include "condyle/results/run_file.h"
#include "condyle/scene/fitted_surface.h"

namespace condyle {

/// Scene, patches, what there is to know of the start, and the meshes of the bodies; nothing
/// computed yet, a sweep until it is said to be something else. `surfaces` as from fit_surfaces.
/// Throws InputError for meshes that cannot be read.
[[nodiscard]] Run make_run(const Scene& scene, const std::vector<FittedSurface>& surfaces);

/// The meshes of a scene, each once, as they are now.
[[nodiscard]] std::vector<InputFile> mesh_files(const Scene& scene);

/// Meshes are read more than once. Throws InputError where one is not as it was.
void expect_same(const std::vector<InputFile>& before, const std::vector<InputFile>& now);

/// Throws InputError where the file to write is one of those that a command reads.
void refuse_to_overwrite(const std::filesystem::path& output,
                         const std::vector<std::filesystem::path>& inputs);

/// The same of the scene, its meshes and its measurements.
void refuse_to_overwrite_inputs(const std::filesystem::path& output, const Scene& scene);

/// The same of the files that a run was computed from: those at its paths, and any that holds the scene or a mesh to the
/// byte.
void refuse_to_overwrite_sources(const std::filesystem::path& output, const Run& run);

}  // namespace condyle
