#include "condyle/specimen/preset_flexion.h"

#include <cmath>

#include "condyle/math/rotation.h"
#include "condyle/scene/ligament_path.h"
#include "condyle/scene/start_pose.h"

namespace condyle {
namespace {

/// Of the tibia as seen from the femur: about the axis that points to the right of the body, by
/// -flexion.
RigidTransform turn(const JointFrames& frames, double flexion) {
  RigidTransform Q;
  Q.R = exp_rotation(-flexion * frames.X_F.R.col(0));
  Q.p = frames.X_F.p - Q.R * frames.X_F.p;
  return Q;
}

}  // namespace

std::vector<PresetPose> preset_poses(const Scene& scene) {
  constexpr double kStep = 30 * M_PI / 180;
  const RigidTransform start = start_pose(scene);
  if (!scene.joint) return {{0, start}};
  const JointFrames frames = joint_frames(scene);
  std::vector<PresetPose> poses;
  for (int i = 0; i < 4; ++i) {
    const RigidTransform Q = turn(frames, i * kStep);
    poses.push_back({i * kStep, frames.tibia_moves ? Q * start : start * Q.inverse()});
  }
  return poses;
}

std::array<Eigen::Vector3d, 2> ends_seen_from(const Scene& scene,
                                              const LigamentDescription& ligament,
                                              int body,
                                              const RigidTransform& X_BA) {
  const auto [x_C, s_D] = fixed_then_moving(scene, ligament.ends);
  if (body == scene.moving_body()) return {s_D, X_BA.inverse() * x_C};
  return {x_C, X_BA * s_D};
}

}  // namespace condyle
