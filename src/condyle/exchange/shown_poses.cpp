#include "condyle/exchange/shown_poses.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include "condyle/input_error.h"
#include "condyle/results/without_poses.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

constexpr double kWholeSweep = 5;      // [s]
constexpr double kShortestStep = 0.1;  // [s], where the swept value stays the same

/// Change of the swept value from each shown pose to the next, together.
double whole_change(const Run& run, const std::vector<ShownPose>& shown) {
  double sum = 0;
  for (std::size_t i = 1; i < shown.size(); ++i) {
    sum +=
        std::abs(run.sweep.poses[shown[i].index].value - run.sweep.poses[shown[i - 1].index].value);
  }
  return sum;
}

}  // namespace

std::vector<ShownPose> shown_poses(const Run& run, const std::string& file) {
  const std::vector<PoseResult>& poses = run.sweep.poses;
  std::vector<ShownPose> shown;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (has_place(poses[i])) shown.push_back({i, poses[i].value});
  }
  if (shown.empty()) {
    throw InputError(file + ": " +
                     (poses.empty() ? no_poses(run) : "holds no pose that converged") +
                     ", expected the result of condyle sweep or simulate");
  }
  if (run.kind() == RunKind::kSimulation) return shown;
  const Unit unit = swept_quantity(run).unit;
  const double per_value = unit.name == "deg"
                               ? 1 / (unit.factor * kDegreesPerSecond)
                               : kWholeSweep / std::max(whole_change(run, shown), 1e-12);
  double time = 0;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    if (i > 0) {
      const double step =
          per_value * std::abs(poses[shown[i].index].value - poses[shown[i - 1].index].value);
      time += step > 1e-6 ? step : kShortestStep;
    }
    shown[i].time = time;
  }
  return shown;
}

std::vector<ShownPose> shown_poses_at(const Run& run,
                                      const std::string& file,
                                      const std::vector<double>& values) {
  const std::vector<ShownPose> all = shown_poses(run, file);
  std::vector<bool> chosen(run.sweep.poses.size());
  for (const double value : values) chosen[nearest_pose_of(run, file, value)] = true;
  std::vector<ShownPose> poses;
  for (const ShownPose& pose : all)
    if (chosen[pose.index]) poses.push_back(pose);
  if (poses.empty()) throw InputError(file + ": no pose at the values of --at has converged");
  return poses;
}

std::vector<ShownPose> converged_only(const Run& run,
                                      const std::string& file,
                                      const std::vector<ShownPose>& shown) {
  std::vector<ShownPose> good;
  for (const ShownPose& pose : shown)
    if (run.sweep.poses[pose.index].converged()) good.push_back(pose);
  if (good.empty()) throw InputError(file + ": none of the poses asked for has converged");
  return good;
}

Vector3d insertion(const Scene& scene, const PoseResult& pose, const Attachment& end) {
  return body_pose(scene, pose.X_BA, end.body) * end.at;
}

Vector3d force_on_moving_body(const ContactResult& contact) {
  Vector3d sum = Vector3d::Zero();
  if (!contact.closed) return sum;
  if (contact.layer) return contact.layer->force;
  for (const ContactPointResult& point : contact.points) sum += point.force * point.normal_ground;
  return sum;
}

Vector3d force_place(const ContactResult& contact) {
  if (contact.closed && contact.resultant_ground.allFinite()) return contact.resultant_ground;
  const ContactPointResult* point = strongest_point(contact);
  return point && point->point_ground.allFinite() ? point->point_ground : Vector3d::Zero();
}

Eigen::Matrix3d upright(const Scene& scene) {
  if (!scene.joint) return Eigen::Matrix3d::Identity();
  const bool femur_fixed = scene.joint->femur.body == scene.fixed_body();
  const AnatomicalFrame& frame = femur_fixed ? scene.joint->femur : scene.joint->tibia;
  Eigen::Matrix3d R;
  R.row(1) = frame.proximal.normalized();
  R.row(2) = (frame.anterior - frame.anterior.dot(R.row(1)) * R.row(1).transpose()).normalized();
  R.row(0) = R.row(1).cross(R.row(2));
  return R;
}

}  // namespace condyle
