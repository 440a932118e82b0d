#pragma once

/// A short sweep of the phantom knee, computed once for all tests of a process.

#include <cmath>

#include "condyle/equilibrium/sweep.h"
#include "condyle/results/run_file.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/specimen/fit_surfaces.h"

namespace condyle::test {

/// 0, 30 and 60 deg; meshes and patches as `condyle sweep` stores them.
inline const Run& phantom_run() {
  static const Run run = [] {
    Run r;
    r.scene = read_scene(CONDYLE_SOURCE_DIR "/data/phantom/knee.toml");
    r.scene.sweep->values = {0, M_PI / 6, M_PI / 3};
    const std::vector<FittedSurface> surfaces = fit_surfaces(r.scene);
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
      const auto& patch = dynamic_cast<const Patch&>(*surfaces[i].surface);
      r.patches.push_back(
          {r.scene.surfaces[i].name, r.scene.surfaces[i].body, patch.data(), *surfaces[i].report});
    }
    for (const BodyDescription& body : r.scene.bodies)
      r.bodies.push_back({body.name, load_body_mesh(body)});
    r.sweep = sweep(r.scene, surfaces);
    return r;
  }();
  return run;
}

}  // namespace condyle::test
