#include "condyle/pictures/knee_shapes.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include "condyle/pictures/solids.h"
#include "condyle/results/run_view.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

constexpr double kThroughBone = 0.62;
constexpr double kThread = 0.24;  // of the radius of a tube
constexpr double kDeepestBow =
    0.16;  // of the length: a very slack ligament must not leave the picture
constexpr int kBowPoints = 13;

std::array<Vector3d, 2> ends_of(const LigamentDescription& ligament,
                                const std::vector<RigidTransform>& X_P) {
  std::array<Vector3d, 2> ends;
  for (std::size_t i = 0; i < 2; ++i)
    ends[i] = X_P[static_cast<std::size_t>(ligament.ends[i].body)] * ligament.ends[i].at;
  return ends;
}

/// Middle of all insertions: slack ligaments bow away from it.
Vector3d middle_of(const Scene& scene, const std::vector<RigidTransform>& X_P) {
  Vector3d sum = Vector3d::Zero();
  for (const LigamentDescription& ligament : scene.ligaments) {
    const auto [a, b] = ends_of(ligament, X_P);
    sum += 0.5 * (a + b);
  }
  return sum / std::max<double>(1, static_cast<double>(scene.ligaments.size()));
}

/// Depth of the parabola over a chord L that is longer than it by the factor 1 + excess: s ≈ L
/// √(3/8 excess).
double bow_depth(double length, double strain) {
  const double excess = -strain / (1 + strain);
  return length * std::min(kDeepestBow, std::sqrt(0.375 * excess));
}

bool is_slack(const LigamentResult& ligament) { return !(ligament.force > 0); }

}  // namespace

Rgb ligament_color(const PictureScales& scales,
                   const LigamentDescription& described,
                   const LigamentResult& ligament) {
  if (is_slack(ligament)) return kSlackColor;
  if (scales.strain_known && !has_strain(described.law)) return kUnstrainedColor;
  return map_color(ColorMap::kStrain,
                   (scales.strain_known ? ligament.strain : ligament.force) / scales.ligament_top);
}

std::vector<Vector3d> ligament_line(const Scene& scene,
                                    const std::vector<RigidTransform>& X_P,
                                    std::size_t ligament,
                                    const PoseResult& pose) {
  const auto [a, b] = ends_of(scene.ligaments[ligament], X_P);
  const LigamentResult& result = pose.ligaments[ligament];
  if (const std::vector<Vector3d> corners = path_corners(scene, pose, ligament); !corners.empty()) {
    const RigidTransform& ground = X_P[static_cast<std::size_t>(scene.fixed_body())];
    std::vector<Vector3d> line = {a};
    for (const Vector3d& corner : corners) line.push_back(ground * corner);
    line.push_back(b);
    return line;
  }
  if (!is_slack(result) || !(result.strain < 0) || !(result.strain > -0.9)) return {a, b};
  const Vector3d axis = (b - a).normalized();
  Vector3d out = 0.5 * (a + b) - middle_of(scene, X_P);
  out -= axis.dot(out) * axis;
  out = out.norm() > 1e-6 ? Vector3d(out.normalized()) : axis.unitOrthogonal();
  const double depth = bow_depth((b - a).norm(), result.strain);
  std::vector<Vector3d> line;
  for (int i = 0; i < kBowPoints; ++i) {
    const double t = static_cast<double>(i) / (kBowPoints - 1);
    line.push_back(a + t * (b - a) + 4 * t * (1 - t) * depth * out);
  }
  return line;
}

ShadedMesh ligament_tubes(const Run& run,
                          const PoseResult& pose,
                          const std::vector<RigidTransform>& X_P,
                          const PictureScales& scales) {
  ShadedMesh mesh;
  for (std::size_t i = 0; i < pose.ligaments.size() && i < run.scene.ligaments.size(); ++i) {
    const LigamentResult& result = pose.ligaments[i];
    const bool slack = is_slack(result);
    const Paint paint = {ligament_color(scales, run.scene.ligaments[i], result),
                         slack ? 0.7 * kThroughBone : kThroughBone};
    std::vector<TubePoint> line;
    for (const Vector3d& p : ligament_line(run.scene, X_P, i, pose)) {
      line.push_back({p, slack ? 0.45 * scales.tube_radius : scales.tube_radius, paint});
    }
    append(mesh, tube(line));
  }
  return mesh;
}

ShadedMesh ligament_threads(const Run& run,
                            const PoseResult& pose,
                            const std::vector<RigidTransform>& X_P,
                            const PictureScales& scales) {
  ShadedMesh mesh;
  for (std::size_t i = 0; i < pose.ligaments.size() && i < run.scene.ligaments.size(); ++i) {
    const Paint paint = {ligament_color(scales, run.scene.ligaments[i], pose.ligaments[i]),
                         0.5 * kThroughBone};
    const auto [a, b] = ends_of(run.scene.ligaments[i], X_P);
    append(mesh, tube({{a, kThread * scales.tube_radius, paint},
                       {b, kThread * scales.tube_radius, paint}}));
    for (const Vector3d& end : {a, b}) append(mesh, ball(end, 0.8 * scales.tube_radius, paint));
  }
  return mesh;
}

ShadedMesh insertions(const Run& run,
                      const PoseResult& pose,
                      int body,
                      const std::vector<RigidTransform>& X_P,
                      const PictureScales& scales) {
  ShadedMesh mesh;
  for (std::size_t i = 0; i < pose.ligaments.size() && i < run.scene.ligaments.size(); ++i) {
    for (const Attachment& end : run.scene.ligaments[i].ends) {
      if (end.body != body) continue;
      append(mesh, ball(X_P[static_cast<std::size_t>(body)] * end.at, 1.05 * scales.tube_radius,
                        {ligament_color(scales, run.scene.ligaments[i], pose.ligaments[i]), 0.8}));
    }
  }
  return mesh;
}

}  // namespace condyle
