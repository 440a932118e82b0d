#pragma once

/// Rigid transform X_AB = (R_AB, p_AB): takes coordinates in frame B to coordinates in frame A,
/// p_A = R_AB p_B + p_AB. Lengths in mm. Multiply as X_AC = X_AB * X_BC: adjacent letters match.

#include <Eigen/Core>

namespace condyle {

struct RigidTransform {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  Eigen::Vector3d p = Eigen::Vector3d::Zero();

  /// A point, [mm]. A template, so only sources that move points instantiate it, and theirs is inline.
  template <int = 0>
  [[nodiscard]] Eigen::Vector3d operator*(const Eigen::Vector3d& point) const {
    return R * point + p;
  }
  [[nodiscard]] RigidTransform operator*(const RigidTransform& other) const;
  [[nodiscard]] RigidTransform inverse() const;
};

}  // namespace condyle
