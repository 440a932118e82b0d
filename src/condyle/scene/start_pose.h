#pragma once

/// Where a sweep starts, and the frames its joint coordinates are measured in.

#include "condyle/elements/joint_coordinates.h"
#include "condyle/math/rigid_transform.h"
#include "condyle/scene/scene.h"

namespace condyle {

/// The frames of the joint coordinates, right-handed for either side; needs scene.joint.
[[nodiscard]] JointFrames joint_frames(const Scene& scene);

/// Start pose X_BA of the moving body in the ground frame: translation of O_A and rotation vector
/// or joint angles.
[[nodiscard]] RigidTransform start_pose(const Scene& scene);

/// Distance between two attachments, on the fixed and the moving body in any order, at a pose [mm].
[[nodiscard]] double distance_between(const Scene& scene,
                                      const std::array<Attachment, 2>& ends,
                                      const RigidTransform& X_BA);

}  // namespace condyle
