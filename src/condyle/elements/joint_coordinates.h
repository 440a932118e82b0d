#pragma once

/// Joint coordinates of Grood and Suntay 1983 between femur and tibia, and their derivatives.
///
/// With I, J, K the femur's and i, j, k the tibia's axes (lateral, anterior, proximal of a right
/// knee), and H from the femur's to the tibia's origin:
///     e1 = I,  e3 = k,  e2 = (e3 x e1)/|e3 x e1|
///     flexion = atan2(k.J, k.K)   adduction = asin(k.I)   internal rotation = atan2(-I.j, I.i)
///     lateral shift = H.e1        anterior drawer = H.e2  distraction = -H.e3
/// For a left knee adduction, internal rotation and lateral shift are mirrored, so that the words
/// keep their anatomical meaning.

#include "condyle/math/rigid_transform.h"

namespace condyle {

/// Angles in rad, translations in mm.
struct JointCoordinates {
  double flexion = 0, adduction = 0, internal_rotation = 0;
  double lateral_shift = 0, anterior_drawer = 0, distraction = 0;
};

/// The anatomical frames as the formulas want them: columns of R are I (or i), J, K, right-handed
/// for either side.
struct JointFrames {
  RigidTransform X_F;       ///< femoral anatomical frame in the femur body's frame
  RigidTransform X_T;       ///< tibial anatomical frame in the tibia body's frame
  bool tibia_moves = true;  ///< the moving body carries the tibial frame (else the femoral)
  double side = 1;          ///< +1 right knee, -1 left knee
};

/// Joint coordinates at the pose X_BA of the moving body A in the ground frame B.
[[nodiscard]] JointCoordinates joint_coordinates(const JointFrames& frames,
                                                 const RigidTransform& X_BA);

/// The pose X_BA that has given joint coordinates.
[[nodiscard]] RigidTransform pose_from_joint_coordinates(const JointFrames& frames,
                                                         const JointCoordinates& q);

/// The rotation R_BA that has the given angles [rad].
[[nodiscard]] Eigen::Matrix3d rotation_from_joint_angles(const JointFrames& frames,
                                                         double flexion,
                                                         double adduction,
                                                         double internal_rotation);

}  // namespace condyle
