#pragma once

/// Bundles that differ by a trailing number only (MCLd1, MCLd2 ...) are strands of one ligament in
/// pictures and plots.

#include <string>
#include <vector>

#include "scene/scene.h"

namespace condyle {

struct LigamentGroup {
  std::string name;                  ///< without the number where there are several strands
  std::vector<std::size_t> strands;  ///< indices of Scene::ligaments
};
/// In the order in which the scene names them first.
[[nodiscard]] std::vector<LigamentGroup> ligament_groups(const Scene& scene);

}  // namespace condyle
