#pragma once

/// A described scene as the text of a scene file (docs/scene.md), but for what needs meshes: a patch names
/// a mesh that need not be there.

#include <string>

#include "condyle/scene/scene.h"

namespace condyle::random_knees {

/// In the units that the scene declares, with all digits.
[[nodiscard]] std::string scene_text(const Scene& scene);

}  // namespace condyle::random_knees
