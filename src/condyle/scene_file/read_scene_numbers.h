#pragma once

/// Names of numbers of the described knee, as derivatives, fits and studies have them in a scene:
/// ["aACL.reference_strain", "*.stiffness", "drawer.scale"]. The words stand in
/// scene/parameter_kind.h; "*" are all ligaments whose law has that number.

#include <string>
#include <vector>

#include "condyle/scene/parameter_kind.h"
#include "condyle/scene_file/section.h"

namespace condyle {

struct Scene;

/// In the order in which they are written, of "*" in that of the scene. All of the scene that they
/// may name is read already. Throws InputError for a name of nothing, for a number that its owner
/// does not have, and for one that is named twice.
[[nodiscard]] std::vector<SceneNumber> read_scene_numbers(const Section& section,
                                                          const std::string& key,
                                                          const Scene& scene);

}  // namespace condyle
