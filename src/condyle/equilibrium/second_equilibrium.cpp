#include "condyle/equilibrium/second_equilibrium.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "condyle/math/rotation.h"

namespace condyle {

double distance(const Model& model, const RigidTransform& a, const RigidTransform& b) {
  return std::hypot((a.p - b.p).norm() / model.length, (a.R - b.R).norm());
}

bool same_pose(const Model& model, const RigidTransform& a, const RigidTransform& b) {
  constexpr double kSame = 1e-6;
  return distance(model, a, b) < kSame;
}

namespace {

/// "3.2 mm and 4.1 degrees"
std::string way(const Model& model, const RigidTransform& here, const RigidTransform& there) {
  // Of the moving joint frame's origin, where there is one: a body's own may lie anywhere.
  const Eigen::Vector3d point =
      !model.joint ? Eigen::Vector3d::Zero()
                   : (model.joint->tibia_moves ? model.joint->X_T.p : model.joint->X_F.p);
  const double turn = log_rotation(there.R * here.R.transpose()).norm() * 180 / M_PI;
  return fmt::format("{:.2g} mm and {:.2g} degrees", (there * point - here * point).norm(), turn);
}

}  // namespace

std::string second_equilibrium(const Model& model,
                               const RigidTransform& here,
                               const RigidTransform& there,
                               const std::string& by) {
  return fmt::format(
      "a second position of equilibrium exists at this value: {} the body rests {} away", by,
      way(model, here, there));
}

namespace {

constexpr std::string_view kSince = "since the pose before it the body moved";
constexpr std::string_view kBetween = "; ";  // sentences of a remark

}  // namespace

std::string jump(const Model& model, const RigidTransform& carried, const RigidTransform& here) {
  constexpr double kJump = 0.5;  // of L
  if (distance(model, carried, here) < kJump) return {};
  return fmt::format("{} {} beyond what is prescribed", kSince, way(model, carried, here));
}

void tell_jump(PoseResult& pose, const std::string& words) {
  const std::size_t begin = pose.remark.find(kSince);
  if (begin == std::string::npos) {
    if (!words.empty()) add_remark(pose, words);
    return;
  }
  std::size_t end = std::min(pose.remark.find(kBetween, begin), pose.remark.size());
  if (!words.empty()) {
    pose.remark.replace(begin, end - begin, words);
  } else if (begin > 0) {
    pose.remark.erase(begin - kBetween.size(), end - begin + kBetween.size());
  } else {
    end = std::min(end + kBetween.size(), pose.remark.size());
    pose.remark.erase(0, end);
  }
}

void add_remark(PoseResult& pose, const std::string& remark) {
  if (pose.remark.find(remark) != std::string::npos) return;
  if (!pose.remark.empty()) pose.remark += kBetween;
  pose.remark += remark;
}

}  // namespace condyle
