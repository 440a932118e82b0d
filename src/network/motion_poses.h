#pragma once

/// The frames of a motion as the poses of a sweep over time, which is how they are stored and
/// shown.

#include "equilibrium/model.h"
#include "equilibrium/pose_result.h"
#include "network/knee_network.h"
#include "network/motion.h"
#include "scene/scene.h"

namespace condyle {

/// One for each frame; PoseResult::value is the time [s].
[[nodiscard]] std::vector<PoseResult> motion_poses(const Scene& scene,
                                                   const Model& model,
                                                   const KneeNetwork& knee,
                                                   const Motion& motion);

}  // namespace condyle
