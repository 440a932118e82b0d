#include "condyle/pictures/staging.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include "condyle/results/run_view.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

constexpr double kTip = 62 * M_PI / 180;
constexpr double kLiftOfWidth = 0.85;  // lift over the distance between the farthest contacts
constexpr double kLeastLift = 40;      // [mm]

/// Contact points of all poses in P, a few for each contact.
std::vector<Vector3d> touching_points(const Run& run) {
  std::vector<Vector3d> points;
  for (const PoseResult& pose : run.sweep.poses) {
    if (!has_place(pose)) continue;
    for (const ContactMark& mark : contact_marks(run.scene, pose)) points.push_back(mark.point);
  }
  return points;
}

}  // namespace

Staging staging_of(const Run& run, View view) {
  Staging staging;
  staging.tibia = view != View::kCondyles;
  staging.femur = view != View::kPlateau;
  if (view != View::kExploded) return staging;
  const std::vector<Vector3d> points = touching_points(run);
  Vector3d middle = Vector3d::Zero();
  for (const Vector3d& p : points) middle += p / static_cast<double>(points.size());
  double width = 0;
  for (const Vector3d& p : points) width = std::max(width, 2 * (p - middle).norm());
  const Anatomy anatomy = anatomy_of(run.scene);
  staging.lifted = 5 * std::round(std::max(kLeastLift, kLiftOfWidth * width) / 5);
  staging.tipped = kTip;
  // From below to the front: distal turns towards anterior.
  const Vector3d axis = anatomy.anterior.cross(anatomy.proximal).normalized();
  staging.lift.R = Eigen::AngleAxisd(kTip, axis).toRotationMatrix();
  staging.lift.p = middle - staging.lift.R * middle + staging.lifted * anatomy.proximal;
  return staging;
}

std::vector<RigidTransform> staged_poses(const Scene& scene,
                                         const Staging& staging,
                                         const RigidTransform& X_BA) {
  std::vector<RigidTransform> poses = body_poses(scene, X_BA);
  const int femur = femur_body(scene);
  if (staging.apart() && femur >= 0) {
    RigidTransform& pose = poses[static_cast<std::size_t>(femur)];
    pose = staging.lift * pose;
  }
  return poses;
}

std::vector<ContactMark> staged_marks(const Scene& scene,
                                      const Staging& staging,
                                      const PoseResult& pose) {
  std::vector<ContactMark> marks = contact_marks(scene, pose);
  if (!staging.apart()) return marks;
  const std::size_t count = marks.size();
  for (std::size_t i = 0; i < count; ++i) {
    ContactMark mark = marks[i];
    mark.point = staging.lift * mark.point;
    mark.toward_femur = staging.lift.R * -mark.toward_femur;  // out of the femur
    if (mark.hertz) mark.hertz->major_axis = staging.lift.R * mark.hertz->major_axis;
    mark.force = 0;  // said once, on the tibia
    marks.push_back(mark);
  }
  return marks;
}

}  // namespace condyle
