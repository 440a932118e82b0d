#pragma once

/// `condyle simulate`: the knee of a scene, released, struck or driven.

#include <vector>

#include "condyle/equilibrium/pose_result.h"
#include "condyle/network/motion.h"
#include "condyle/on_progress.h"
#include "condyle/scene/fitted_surface.h"
#include "condyle/scene/scene.h"

namespace condyle {

/// A motion as poses over time (PoseResult::value is the time in s) with what only a motion has.
struct Simulation {
  MassProperties mass;            ///< of the moving body
  std::vector<PoseResult> poses;  ///< one for each frame
  Motion motion;                  ///< frames as the network has them
  double seconds = 0;             ///< of computing
  std::vector<int> contact_of;    ///< index into Scene::contacts of each contact of the network
};

/// Mass of the moving body: its numbers, or its mesh and density. Throws InputError where the scene
/// says neither.
[[nodiscard]] MassProperties moving_mass(const Scene& scene);

/// Needs scene.simulation. Throws InputError for a body without mass, an open mesh, or a start that
/// is no equilibrium. `on_frame` is told of each frame.
[[nodiscard]] Simulation simulate(const Scene& scene,
                                  const std::vector<FittedSurface>& surfaces,
                                  const OnProgress& on_frame = {});

}  // namespace condyle
