#include "equilibrium/build_model.h"

#include <cassert>

#include "math/rotation.h"

namespace condyle {
namespace {

/// Columns I, J, K: on a left knee the first axis is medial, which makes the triad right-handed.
RigidTransform right_handed(const AnatomicalFrame& frame, Side side) {
  RigidTransform X;
  X.R.col(0) = side == Side::kRight ? frame.lateral : Eigen::Vector3d(-frame.lateral);
  X.R.col(1) = frame.anterior;
  X.R.col(2) = frame.proximal;
  X.p = frame.origin;
  return X;
}

/// Orders two ends as (on B, on A).
std::array<Eigen::Vector3d, 2> fixed_then_moving(const std::array<Attachment, 2>& ends, int fixed) {
  if (ends[0].body == fixed) return {ends[0].at, ends[1].at};
  return {ends[1].at, ends[0].at};
}

ContactMode mode_of(ContactState state) {
  switch (state) {
    case ContactState::kClosed: return ContactMode::kClosed;
    case ContactState::kOpen: return ContactMode::kOpen;
    default: return ContactMode::kAuto;
  }
}

RigidTransform start_pose(const Scene& scene) {
  const BodyDescription& body = scene.bodies[scene.moving_body()];
  RigidTransform X{exp_rotation(body.start_rotation), body.start_translation};
  if (body.start_joint_angles) {
    const auto& [flexion, adduction, internal_rotation] = *body.start_joint_angles;
    X.R = rotation_from_joint_angles(joint_frames(scene), flexion, adduction, internal_rotation);
  }
  return X;
}

}  // namespace

JointFrames joint_frames(const Scene& scene) {
  assert(scene.joint);
  JointFrames frames;
  frames.X_F = right_handed(scene.joint->femur, scene.joint->side);
  frames.X_T = right_handed(scene.joint->tibia, scene.joint->side);
  frames.tibia_moves = scene.joint->tibia.body == scene.moving_body();
  frames.side = scene.joint->side == Side::kRight ? 1 : -1;
  return frames;
}

Model build_model(const Scene& scene, const std::vector<FittedSurface>& surfaces) {
  const int fixed = scene.fixed_body();
  Model model;
  model.start = start_pose(scene);
  if (scene.joint) model.joint = joint_frames(scene);
  for (const LigamentDescription& ligament : scene.ligaments) {
    const auto [x_C, s_D] = fixed_then_moving(ligament.ends, fixed);
    model.elements.push_back({x_C, s_D, ligament.law});
    model.element_names.push_back(ligament.name);
  }
  for (const ConditionDescription& description : scene.conditions) {
    KinematicCondition condition;
    condition.kind = description.kind;
    condition.value = description.value;
    condition.axis = description.axis;
    condition.cardan_axis = description.cardan_axis;
    if (model.joint) condition.frames = *model.joint;
    if (description.kind == ConditionKind::kDistance) {
      const auto [x_C, s_D] = fixed_then_moving(description.ends, fixed);
      condition.x_C = x_C;
      condition.s_D = s_D;
    }
    model.conditions.push_back(condition);
    model.condition_names.push_back(description.name);
  }
  for (const LoadDescription& description : scene.loads) {
    Load load;
    load.moment = description.moment;
    load.follows_body = description.follows_body;
    load.vector = description.vector;
    load.at = description.at;
    model.loads.push_back(load);
    model.load_names.push_back(description.name);
  }
  for (const ContactDescription& description : scene.contacts) {
    ContactPair pair;
    pair.name = description.name;
    const auto [first, second] = description.surfaces;
    const bool first_fixed = scene.surfaces[first].body == fixed;
    pair.on_B = surfaces[first_fixed ? first : second].surface;
    pair.on_A = surfaces[first_fixed ? second : first].surface;
    pair.mode = mode_of(description.state);
    pair.start = description.start;
    model.pairs.push_back(std::move(pair));
  }
  model.length = characteristic_length(model);
  return model;
}

}  // namespace condyle
