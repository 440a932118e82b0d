#pragma once

/// Poses for looking at bones and ligaments before anything is solved: the start pose, and from there
/// flexed about the lateral axis of the femur's anatomical frame. No motion of a knee, but near one.

#include <array>
#include <vector>

#include "condyle/scene/scene.h"

namespace condyle {

struct PresetPose {
  double flexion = 0;  ///< from the start pose [rad]
  RigidTransform X_BA;
};

/// Flexed by 0, 30, 60 and 90 degrees; without [joint] the start pose alone.
[[nodiscard]] std::vector<PresetPose> preset_poses(const Scene& scene);

/// The ends of a ligament at a pose, that on `body` first, in the frame of `body` [mm].
[[nodiscard]] std::array<Eigen::Vector3d, 2> ends_seen_from(const Scene& scene,
                                                            const LigamentDescription& ligament,
                                                            int body,
                                                            const RigidTransform& X_BA);

}  // namespace condyle
