#pragma once

/// Where a model has the origins of its two bodies' frames, in the frames that its files use:
/// points in the joint, so that lever arms, moments and steps do not depend on where a scanner had
/// its zero. Directions are the files' own. Lengths in mm; no origins: the files' frames.

#include "condyle/elements/joint_coordinates.h"
#include "condyle/math/rigid_transform.h"

namespace condyle {

struct BodyOrigins {
  Eigen::Vector3d B = Eigen::Vector3d::Zero(), A = Eigen::Vector3d::Zero();

  /// A pose of A in B, from the files' frames to the model's and back.
  [[nodiscard]] RigidTransform into_model(const RigidTransform& X_BA) const {
    return {X_BA.R, X_BA.p + X_BA.R * A - B};
  }
  [[nodiscard]] RigidTransform out_of_model(const RigidTransform& X_BA) const {
    return {X_BA.R, X_BA.p + B - X_BA.R * A};
  }
  [[nodiscard]] JointFrames into_model(JointFrames frames) const {
    frames.X_F.p -= frames.tibia_moves ? B : A;
    frames.X_T.p -= frames.tibia_moves ? A : B;
    return frames;
  }
};

}  // namespace condyle
