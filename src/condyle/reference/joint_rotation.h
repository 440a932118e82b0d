#pragma once

/// The rotation of the moving body as a function of three angles, with its derivatives. The engine
/// turns a rotation by small vectors; this model has the angles themselves as unknowns, so the two
/// have nothing in common but the definition of the angles [Grood and Suntay 1983]:
///     G = Rx(-flexion) Ry(s adduction) Rz(s internal rotation),   s = -1 for a left knee,
/// turns tibial axes into femoral ones.

#include <Eigen/Core>

#include "condyle/elements/joint_coordinates.h"

namespace condyle {

/// Index 0 flexion, 1 adduction, 2 internal rotation.
struct JointRotation {
  Eigen::Matrix3d R;         ///< R_BA
  Eigen::Matrix3d d[3];      ///< ∂R/∂angle
  Eigen::Matrix3d dd[3][3];  ///< second derivatives
};
[[nodiscard]] JointRotation joint_rotation(const JointFrames& frames,
                                           const Eigen::Vector3d& angles);

}  // namespace condyle
