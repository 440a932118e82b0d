#pragma once

/// The knee of data/wismans-type/drawer.toml with ligaments cut and another load: its equilibria pass over edges, fold
/// and jump.

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "condyle/math/degree.h"
#include "condyle/scene_file/read_scene.h"

namespace condyle::test {

struct DrawerKnee {
  std::vector<std::string> cut;
  double flexion = 0;  ///< [degrees]
  Eigen::Vector3d force, at{0, 0, 213};
  bool follows_body = false;

  /// Swept over these factors of the force.
  [[nodiscard]] Scene scene(const std::vector<double>& factors, bool arc_length) const {
    Scene scene =
        read_scene(std::filesystem::path(CONDYLE_SOURCE_DIR) / "data/wismans-type/drawer.toml");
    std::erase_if(scene.ligaments, [&](const LigamentDescription& ligament) {
      return std::find(cut.begin(), cut.end(), ligament.name) != cut.end();
    });
    scene.laxity.reset();
    scene.conditions[0].value = flexion * kDegree;
    LoadDescription& load = scene.loads[0];
    load.vector = force;
    load.at = at;
    load.follows_body = follows_body;
    scene.sweep->values = factors;
    scene.sweep->arc_length = arc_length;
    return scene;
  }
};

}  // namespace condyle::test
