#pragma once

/// The sweep: positions of equilibrium of a scene over a range of a prescribed motion or a load.

#include <functional>
#include <vector>

#include "equilibrium/pose_result.h"
#include "scene/fit_surfaces.h"
#include "scene/scene.h"

namespace condyle {

struct SweepOptions {
  bool stability = true;  ///< reduced stiffness of each pose
  bool events = true;     ///< locate what happens to contacts between poses
  std::function<void(const PoseResult&)> on_pose;  ///< called after each pose, in order
};

/// One door: solves every value of scene.sweep in order, each from the pose before it. Never throws
/// for mathematics that does not succeed: a pose carries its status. `surfaces` as from
/// fit_surfaces.
[[nodiscard]] SweepResult sweep(const Scene& scene,
                                const std::vector<FittedSurface>& surfaces,
                                const SweepOptions& options = {});

}  // namespace condyle
