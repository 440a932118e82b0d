#pragma once

/// The bundles that pictures and plots show as one; a strand that is alone keeps its whole name.

#include <vector>

#include "condyle/scene/ligament_bundles.h"
#include "condyle/scene/scene.h"

namespace condyle {

[[nodiscard]] std::vector<LigamentBundle> ligament_groups(const Scene& scene);

}  // namespace condyle
