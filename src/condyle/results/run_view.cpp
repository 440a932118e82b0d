#include "condyle/results/run_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "condyle/compare/compare.h"
#include "condyle/input_error.h"
#include "condyle/scene/ligament_path.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

constexpr double kRounding = 0.5;  // [deg] or [mm] by which an asked value may lie beyond the run

}  // namespace

bool has_place(const PoseResult& pose) {
  if (pose.converged()) return true;
  return pose.status == PoseStatus::kLeftPatch && pose.X_BA.p.allFinite() &&
         std::any_of(pose.contacts.begin(), pose.contacts.end(),
                     [](const ContactResult& contact) { return contact.closed; });
}

int count_with_place(const SweepResult& sweep) {
  return static_cast<int>(std::count_if(sweep.poses.begin(), sweep.poses.end(), has_place));
}

double beyond_edge(const ContactPointResult& point) { return std::max(0.0, -point.edge_distance); }

double beyond_edge(const ContactResult& contact) {
  double farthest = 0;
  for (const ContactPointResult& point : contact.points)
    if (contact.closed) farthest = std::max(farthest, beyond_edge(point));
  return farthest;
}

double beyond_edge(const PoseResult& pose) {
  double farthest = 0;
  for (const ContactResult& contact : pose.contacts)
    farthest = std::max(farthest, beyond_edge(contact));
  return farthest;
}

std::string event_subject(const Scene& scene, const Event& event) {
  if (event.ligament >= 0) {
    const LigamentDescription& ligament =
        scene.ligaments.at(static_cast<std::size_t>(event.ligament));
    const int wrap = wrap_on_path(scene, ligament, event.wrap);
    return ligament.name + " on " + scene.wraps.at(static_cast<std::size_t>(wrap)).name;
  }
  return event.contact < 0 ? "" : scene.contacts.at(static_cast<std::size_t>(event.contact)).name;
}

std::string short_time(double seconds, const std::string& micro) {
  if (std::abs(seconds) < 999.5e-6) return fmt::format("{:.3g} {}", 1e6 * seconds, micro);
  if (std::abs(seconds) < 0.9995) return fmt::format("{:.3g} ms", 1e3 * seconds);
  return fmt::format("{:.{}f} s", seconds, seconds < 9.995 ? 2 : seconds < 99.95 ? 1 : 0);
}

SweptQuantity swept_quantity(const Run& run) {
  if (run.kind() == RunKind::kSimulation) return quantity_of_motion();
  const bool none = run.kind() == RunKind::kFit || run.kind() == RunKind::kCalibration;
  return none ? SweptQuantity{} : quantity_of_sweep(run.scene);
}

bool is_swept(const Run& run, std::size_t coordinate) {
  const int condition = swept_quantity(run).condition;
  return condition >= 0 && run.scene.conditions.at(static_cast<std::size_t>(condition)).kind ==
                               static_cast<ConditionKind>(coordinate);
}

const SweepResult* reference_poses(const Run& run) {
  const Comparison* comparison = run.comparison();
  return comparison == nullptr ? nullptr : &comparison->reference;
}

std::size_t nearest_pose_of(const Run& run, const std::string& file, double value) {
  const std::vector<PoseResult>& poses = run.sweep.poses;
  const SweptQuantity swept = swept_quantity(run);
  double low = std::numeric_limits<double>::infinity(), high = -low, least = low;
  std::size_t nearest = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const double shown = swept.shown(poses[i].value);
    low = std::min(low, shown);
    high = std::max(high, shown);
    if (!(std::abs(shown - value) < least)) continue;
    least = std::abs(shown - value);
    nearest = i;
  }
  const bool rounded = swept.unit.name == "deg" || swept.unit.name == "mm";
  const double margin = rounded ? kRounding : 0.02 * (high - low) + 1e-9 * std::abs(high);
  if (value >= low - margin && value <= high + margin) return nearest;
  throw InputError(fmt::format("--at {:g}: {} holds {:g} to {:g} {}", value, file, low, high,
                               swept.unit.name == "1" ? "(" + swept.title + ")" : swept.unit.name));
}

double ligament_radius(const Scene& scene) {
  const auto strands = static_cast<double>(scene.ligaments.size());
  return 1.5 * std::min(1.0, std::sqrt(20 / std::max(1.0, strands)));
}

Vector3d place_of_interest(const Run& run, int body) {
  for (const PoseResult& pose : run.sweep.poses) {
    if (!has_place(pose)) continue;
    for (const ContactResult& contact : pose.contacts) {
      const ContactPointResult* point = strongest_point(contact);
      if (point == nullptr) continue;
      const Eigen::Vector3d& place =
          body == run.scene.moving_body() ? point->point_moving : point->point_ground;
      if (place.allFinite()) return place;  // a damaged file may hold others
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

const RunPatch* patch_of(const Run& run, const std::string& surface) {
  const auto patch = std::find_if(run.patches.begin(), run.patches.end(),
                                  [&](const RunPatch& p) { return p.surface == surface; });
  return patch == run.patches.end() ? nullptr : &*patch;
}

RigidTransform body_pose(const Scene& scene, const RigidTransform& X_BA, int body) {
  return body == scene.moving_body() ? X_BA : RigidTransform();
}

std::vector<Eigen::Vector3d> path_corners(const Scene& scene,
                                          const PoseResult& pose,
                                          std::size_t ligament) {
  if (ligament >= pose.paths.size()) return {};
  std::vector<Eigen::Vector3d> corners = pose.paths[ligament].points;
  if (scene.ligaments[ligament].ends[0].body != scene.fixed_body())
    std::reverse(corners.begin(), corners.end());
  return corners;
}

int tibia_body(const Scene& scene) {
  return scene.joint ? scene.joint->tibia.body : scene.moving_body();
}

int femur_body(const Scene& scene) {
  return scene.joint ? scene.joint->femur.body : scene.fixed_body();
}

}  // namespace condyle
