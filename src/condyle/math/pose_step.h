#pragma once

/// Steps between poses in scaled components (da, L dπ) [mm]: rotations count at an arm of L mm.

#include <Eigen/Core>

#include <cmath>

#include "condyle/math/rigid_transform.h"
#include "condyle/math/rotation.h"

namespace condyle {

/// X moved by a step.
[[nodiscard]] inline RigidTransform moved_by(const RigidTransform& X,
                                             const Eigen::Matrix<double, 6, 1>& step,
                                             double L) {
  return {exp_rotation(step.tail<3>() / L) * X.R, X.p + step.head<3>()};
}

/// The step that leads from one pose to another, by the shorter turn.
[[nodiscard]] inline Eigen::Matrix<double, 6, 1> step_between(const RigidTransform& from,
                                                              const RigidTransform& to,
                                                              double L) {
  Eigen::Matrix<double, 6, 1> step;
  step << to.p - from.p, L * log_rotation(to.R * from.R.transpose());
  return step;
}

/// Its length [mm].
[[nodiscard]] inline double distance_between(const RigidTransform& from,
                                             const RigidTransform& to,
                                             double L) {
  return std::hypot((to.p - from.p).norm(), L * log_rotation(to.R * from.R.transpose()).norm());
}

}  // namespace condyle
