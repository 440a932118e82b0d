#include "condyle/calibration/measured_frames.h"

#include <Eigen/Geometry>

#include <cmath>

#include "condyle/equilibrium/joint_stiffness.h"
#include "condyle/math/rotation.h"

namespace condyle {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Motion = Eigen::Matrix<double, 6, 1>;  // of a body: of its origin, and its turn

Vector3d shift_of(const std::array<double, 6>& offset) { return {offset[0], offset[1], offset[2]}; }
Vector3d turn_of(const std::array<double, 6>& offset) { return {offset[3], offset[4], offset[5]}; }

RigidTransform moved(const RigidTransform& X, const std::array<double, 6>& offset) {
  return {X.R * exp_rotation(turn_of(offset)), X.p + X.R * shift_of(offset)};
}

/// J with exp(w + dw) = exp(w) exp(J dw), J = I - (1 - cos w)/w² [w]x + (w - sin w)/w³ [w]x².
Matrix3d right_jacobian(const Vector3d& w) {
  const double angle = w.norm(), half = std::sin(angle / 2);
  const Matrix3d W = skew(w);
  const bool small = angle < 1e-3;
  const double a2 = angle * angle;
  const double first = small ? 0.5 - a2 / 24 : 2 * half * half / a2;
  const double second = small ? 1.0 / 6 - a2 / 120 : (angle - std::sin(angle)) / (a2 * angle);
  return Matrix3d::Identity() - first * W + second * W * W;
}

/// How a frame moves in the ground frame by one of its six numbers: its origin and its turn.
struct FrameMotion {
  Vector3d dp = Vector3d::Zero(), dpi = Vector3d::Zero();
};

FrameMotion motion_of(const RigidTransform& X,
                      const Matrix3d& R_ground,
                      const std::array<double, 6>& offset,
                      int number) {
  FrameMotion motion;
  if (number < 3) {
    motion.dp = R_ground * X.R.col(number);
  } else {
    const Vector3d w = turn_of(offset);
    motion.dpi = R_ground * (X.R * (exp_rotation(w) * right_jacobian(w).col(number - 3)));
  }
  return motion;
}

}  // namespace

JointFrames moved_frames(const JointFrames& frames, const FrameOffsets& offsets) {
  JointFrames result = frames;
  result.X_F = moved(frames.X_F, offsets.femur);
  result.X_T = moved(frames.X_T, offsets.tibia);
  return result;
}

Eigen::Matrix<double, 6, 12> derivatives_by_frames(const JointFrames& frames,
                                                   const FrameOffsets& offsets,
                                                   const RigidTransform& X_BA) {
  const JointFrames told = moved_frames(frames, offsets);
  const Eigen::Matrix<double, 6, 6> J = joint_jacobian(told, X_BA);
  // The frame that A carries, about whose origin what moves is told.
  const Vector3d arm = X_BA.R * (frames.tibia_moves ? told.X_T : told.X_F).p;
  Eigen::Matrix<double, 6, 12> result;
  for (int column = 0; column < 12; ++column) {
    const bool of_femur = column < 6, on_A = of_femur != frames.tibia_moves;
    const FrameMotion frame =
        motion_of(of_femur ? frames.X_F : frames.X_T, on_A ? X_BA.R : Matrix3d::Identity(),
                  of_femur ? offsets.femur : offsets.tibia, column % 6);
    // A moves with its own frame; a frame of B that moves is A moving the other way.
    Motion motion;
    if (on_A) {
      motion << frame.dp - frame.dpi.cross(arm), frame.dpi;
    } else {
      const Vector3d from = (of_femur ? told.X_F : told.X_T).p;
      motion << -(frame.dp + frame.dpi.cross(X_BA.p - from)), -frame.dpi;
    }
    result.col(column) = J * motion;
  }
  return result;
}

}  // namespace condyle
