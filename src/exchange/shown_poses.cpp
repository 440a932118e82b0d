#include "exchange/shown_poses.h"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

#include "input_error.h"
#include "results/run_layout.h"
#include "scene/sweep_range.h"

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

ShownUnit shown_unit(const Scene& scene) {
  if (scene.simulation) return {"s", 1};
  if (!scene.sweep) return {"1", 1};
  const Unit unit = border_sweep_unit(scene);
  return {unit.name, 1 / unit.factor};
}

std::vector<ShownPose> shown_poses(const Run& run, const std::string& file) {
  const std::vector<PoseResult>& poses = run.sweep.poses;
  std::vector<ShownPose> shown;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (poses[i].converged()) shown.push_back({i, poses[i].value});
  }
  if (shown.empty()) {
    throw InputError(file +
                     ": holds no pose that converged, expected the result of condyle sweep "
                     "or simulate");
  }
  if (run.scene.simulation) return shown;
  const ShownUnit unit = shown_unit(run.scene);
  const double per_value = unit.name == "deg"
                               ? unit.per_inside / kDegreesPerSecond
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
  const ShownUnit unit = shown_unit(run.scene);
  const auto shown = [&](const ShownPose& pose) {
    return unit.per_inside * run.sweep.poses[pose.index].value;
  };
  double low = shown(all[0]), high = low;
  for (const ShownPose& pose : all) {
    low = std::min(low, shown(pose));
    high = std::max(high, shown(pose));
  }
  const double margin = 0.02 * (high - low) + 0.5;
  std::vector<bool> chosen(all.size());
  for (const double value : values) {
    if (!(value > low - margin && value < high + margin)) {
      throw InputError(
          fmt::format("--at {:g}: {} holds {:g} to {:g} {}", value, file, low, high, unit.name));
    }
    const auto nearest =
        std::min_element(all.begin(), all.end(), [&](const ShownPose& a, const ShownPose& b) {
          return std::abs(shown(a) - value) < std::abs(shown(b) - value);
        });
    chosen[static_cast<std::size_t>(nearest - all.begin())] = true;
  }
  std::vector<ShownPose> poses;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (chosen[i]) poses.push_back(all[i]);
  return poses;
}

RigidTransform body_pose(const Scene& scene, const PoseResult& pose, int body) {
  return body == scene.moving_body() ? pose.X_BA : RigidTransform();
}

Vector3d insertion(const Scene& scene, const PoseResult& pose, const Attachment& end) {
  return body_pose(scene, pose, end.body) * end.at;
}

const ContactPointResult* strongest_point(const ContactResult& contact) {
  const auto strongest = std::max_element(
      contact.points.begin(), contact.points.end(),
      [](const ContactPointResult& a, const ContactPointResult& b) { return a.force < b.force; });
  return strongest == contact.points.end() ? nullptr : &*strongest;
}

Vector3d force_on_moving_body(const ContactResult& contact) {
  Vector3d sum = Vector3d::Zero();
  if (!contact.closed) return sum;
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

Vector3d place_of_interest(const Run& run, int body) {
  for (const PoseResult& pose : run.sweep.poses) {
    if (!pose.converged()) continue;
    for (const ContactResult& contact : pose.contacts) {
      if (const ContactPointResult* point = strongest_point(contact))
        return body == run.scene.moving_body() ? point->point_moving : point->point_ground;
    }
  }
  return Vector3d::Zero();
}

int body_named(const Scene& scene, const std::string& name) {
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    if (scene.bodies[i].name == name) return static_cast<int>(i);
  }
  return -1;
}

}  // namespace condyle
