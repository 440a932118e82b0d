#include "phantom/exact_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "phantom/exact_bone.h"

namespace condyle::phantom {
namespace {

/// Sum over the ligaments whose name holds `part` [N].
double force_of(const Scene& scene, const PoseResult& pose, const std::string& part) {
  double sum = 0;
  for (std::size_t i = 0; i < scene.ligaments.size(); ++i)
    if (scene.ligaments[i].name.find(part) != std::string::npos) sum += pose.ligaments[i].force;
  return sum;
}

std::string row(const Scene& scene, const PoseResult& pose) {
  const auto x = [&](std::size_t contact) {
    return pose.contacts[contact].points.front().point_moving.x();
  };
  std::string text = fmt::format(
      "| {:.0f}° | {:.1f}° | {:.1f}° | {:.1f} | {:.1f} | {:.0f} / {:.0f} |", pose.value / kDegree,
      pose.joint.internal_rotation / kDegree, pose.joint.adduction / kDegree, x(0), x(1),
      pose.contacts[0].force, pose.contacts[1].force);
  for (const char* part : {"ACL", "PCL", "MCL", "LCL", "CAP"})
    text += fmt::format(" {:.0f} |", force_of(scene, pose, part));
  return text + "\n";
}

}  // namespace

std::vector<FittedSurface> exact_surfaces(const Scene& scene, const PhantomParameters& knee) {
  std::vector<FittedSurface> surfaces;
  for (const SurfaceDescription& s : scene.surfaces) {
    const Bone bone = scene.bodies[static_cast<std::size_t>(s.body)].name == "femur" ? Bone::kFemur
                                                                                     : Bone::kTibia;
    const int side = s.patch.compartment == Compartment::kMedial ? -1 : 1;
    surfaces.push_back({std::make_shared<ExactBone>(bone, side, knee), std::nullopt});
  }
  return surfaces;
}

std::string motion_table(const Scene& scene,
                         const SweepResult& sweep,
                         const std::vector<double>& flexions_deg) {
  std::string text =
      "| flexion | internal rotation | adduction | medial x | lateral x | contact N, medial / "
      "lateral | ACL N | PCL N | MCL N (all) | LCL N | capsule N |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const double flexion : flexions_deg) {
    const auto at = std::find_if(sweep.poses.begin(), sweep.poses.end(), [&](const PoseResult& p) {
      return std::abs(p.value / kDegree - flexion) < 1e-6;
    });
    if (at == sweep.poses.end() || !at->converged())
      text += fmt::format("| {:.0f}° | nan |\n", flexion);
    else
      text += row(scene, *at);
  }
  return text;
}

}  // namespace condyle::phantom
