#include "condyle/scene/start_pose.h"

#include <cassert>

#include "condyle/elements/joint_coordinates.h"
#include "condyle/math/rotation.h"

namespace condyle {
namespace {

// The first axis points to the right of the body on either side: a left knee's lateral axis is
// turned round.
RigidTransform right_handed(const AnatomicalFrame& frame, Side side) {
  RigidTransform X;
  X.R.col(0) = side == Side::kRight ? frame.lateral : Eigen::Vector3d(-frame.lateral);
  X.R.col(1) = frame.anterior;
  X.R.col(2) = frame.proximal;
  X.p = frame.origin;
  return X;
}

}  // namespace

JointFrames joint_frames(const Scene& scene) {
  assert(scene.joint.has_value());
  JointFrames frames;
  frames.X_F = right_handed(scene.joint->femur, scene.joint->side);
  frames.X_T = right_handed(scene.joint->tibia, scene.joint->side);
  frames.tibia_moves = scene.joint->tibia.body == scene.moving_body();
  frames.side = scene.joint->side == Side::kRight ? 1 : -1;
  return frames;
}

RigidTransform start_pose(const Scene& scene) {
  const BodyDescription& body = scene.bodies[static_cast<std::size_t>(scene.moving_body())];
  RigidTransform X_BA;
  X_BA.p = body.start_translation;
  if (body.start_joint_angles) {
    const auto& [flexion, adduction, internal_rotation] = *body.start_joint_angles;
    X_BA.R = rotation_from_joint_angles(joint_frames(scene), flexion, adduction, internal_rotation);
  } else {
    X_BA.R = exp_rotation(body.start_rotation);
  }
  return X_BA;
}

double distance_between(const Scene& scene,
                        const std::array<Attachment, 2>& ends,
                        const RigidTransform& X_BA) {
  const int moving = scene.moving_body();
  const auto in_ground = [&](const Attachment& end) {
    return end.body == moving ? Eigen::Vector3d(X_BA * end.at) : end.at;
  };
  return (in_ground(ends[1]) - in_ground(ends[0])).norm();
}

}  // namespace condyle
