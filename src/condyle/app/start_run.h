#pragma once

/// A scene at its start pose as a run that pictures can be drawn of.

#include <string>
#include <vector>

#include "condyle/results/run_file.h"
#include "condyle/scene/fitted_surface.h"

namespace condyle {

/// The scene's meshes and patches with one pose, the start pose: joint coordinates, and lengths, strains and
/// forces of the ligaments along their paths. Nothing is solved. `scene`: its wraps are fitted; `surfaces`: so
/// are its patches.
[[nodiscard]] Run start_run(const Scene& scene, const std::vector<FittedSurface>& surfaces);

/// Throws InputError where a picture cannot become that file, or would be under the name of another format.
void check_scene_page(const std::string& file);

/// Draws it into a PNG file (pictures/scene_page.h).
void write_scene_page(const std::string& file,
                      const Run& run,
                      const std::vector<std::string>& remarks);

}  // namespace condyle
