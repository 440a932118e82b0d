#pragma once

/// The frames of a motion as the poses of a sweep over time, which is how they are stored and
/// shown.

#include "condyle/equilibrium/model.h"
#include "condyle/equilibrium/pose_result.h"
#include "condyle/network/knee_network.h"
#include "condyle/network/motion.h"
#include "condyle/scene/scene.h"

namespace condyle {

/// One for each frame; PoseResult::value is the time [s].
[[nodiscard]] std::vector<PoseResult> motion_poses(const Scene& scene,
                                                   const Model& model,
                                                   const ContactCovers& covers,
                                                   const KneeNetwork& knee,
                                                   const Motion& motion);

}  // namespace condyle
