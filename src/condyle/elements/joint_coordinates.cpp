#include "condyle/elements/joint_coordinates.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace condyle {
namespace {

Eigen::Matrix3d about(const Eigen::Vector3d& axis, double angle) {
  return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

}  // namespace

JointCoordinates joint_coordinates(const JointFrames& frames, const RigidTransform& X_BA) {
  // Both anatomical frames in the ground frame; columns of F are I, J, K and of T are i, j, k.
  const RigidTransform F = frames.tibia_moves ? frames.X_F : X_BA * frames.X_F;
  const RigidTransform T = frames.tibia_moves ? X_BA * frames.X_T : frames.X_T;
  const Eigen::Vector3d e1 = F.R.col(0), e3 = T.R.col(2), n = e3.cross(e1), H = T.p - F.p;
  const double cosine = std::max(n.norm(), 1e-12);
  const double s = frames.side;
  JointCoordinates q;
  q.flexion = std::atan2(e3.dot(F.R.col(1)), e3.dot(F.R.col(2)));
  q.adduction = s * std::atan2(e3.dot(e1), n.norm());
  q.internal_rotation = s * std::atan2(-e1.dot(T.R.col(1)), e1.dot(T.R.col(0)));
  q.lateral_shift = s * H.dot(e1);
  q.anterior_drawer = H.dot(n) / cosine;
  q.distraction = -H.dot(e3);
  return q;
}

RigidTransform pose_from_joint_coordinates(const JointFrames& frames, const JointCoordinates& q) {
  RigidTransform X;
  X.R = rotation_from_joint_angles(frames, q.flexion, q.adduction, q.internal_rotation);
  const Eigen::Vector3d e1 = (frames.tibia_moves ? frames.X_F.R : X.R * frames.X_F.R).col(0);
  const Eigen::Vector3d e3 = (frames.tibia_moves ? X.R * frames.X_T.R : frames.X_T.R).col(2);
  const Eigen::Vector3d n = e3.cross(e1);
  // H.e1, H.n and H.e3 are given; e1 and e3 need not be at right angles.
  Eigen::Matrix3d axes;
  axes << e1.transpose(), n.transpose(), e3.transpose();
  const Eigen::Vector3d along(frames.side * q.lateral_shift, q.anterior_drawer * n.norm(),
                              -q.distraction);
  const Eigen::Vector3d H = axes.fullPivLu().solve(along);
  X.p = frames.tibia_moves ? Eigen::Vector3d(frames.X_F.p + H - X.R * frames.X_T.p)
                           : Eigen::Vector3d(frames.X_T.p - H - X.R * frames.X_F.p);
  return X;
}

Eigen::Matrix3d rotation_from_joint_angles(const JointFrames& frames,
                                           double flexion,
                                           double adduction,
                                           double internal_rotation) {
  // Tibial triad in the femoral one: about I by -flexion, about the floating axis, then about k.
  const Eigen::Matrix3d R_FT = about(Eigen::Vector3d::UnitX(), -flexion) *
                               about(Eigen::Vector3d::UnitY(), frames.side * adduction) *
                               about(Eigen::Vector3d::UnitZ(), frames.side * internal_rotation);
  if (frames.tibia_moves) return frames.X_F.R * R_FT * frames.X_T.R.transpose();
  return frames.X_T.R * R_FT.transpose() * frames.X_F.R.transpose();
}

}  // namespace condyle
