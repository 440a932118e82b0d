#include "condyle/anatomy/knee_side.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "condyle/math/decompositions.h"
#include "condyle/mesh/mesh_measures.h"
#include "condyle/surface/bone_check.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

/// A feature that is +mean in right knees and -mean in left ones, with the same spread.
struct Feature {
  double mean, spread;
  double most;  // what it may say at most, since no spread is that of a normal distribution
};

double log_ratio(const Feature& f, double value) {
  return std::clamp(2 * f.mean * value / (f.spread * f.spread), -f.most, f.most);
}

/// How far either half of the femur's end reaches along (sin, -cos) of an angle from distal forward.
std::array<double, 2> reach(const FemoralShape& femur, double angle) {
  const Vector3d along(std::sin(angle), -std::cos(angle), 0);
  std::array<double, 2> most = {-1e300, -1e300};
  for (const Vector3d& p : femur.end.vertices) {
    const Vector3d q = femur.frame.components(p - femur.frame.origin);
    if (std::abs(q.z()) < 0.05 * femur.width || q.y() > 1.2 * femur.cylinder.radius) continue;
    double& side = most[q.z() > 0];
    side = std::max(side, along.dot(q));
  }
  return most;
}

double lateral_reach_ahead(const FemoralShape& femur, double angle) {
  const auto [medial, lateral] = reach(femur, angle);
  return (lateral - medial) / femur.width;
}

/// Sagittal curvature of one half's middle strip times the plateau's width, hollow positive.
double hollowness(const TibialShape& tibia,
                  const TriangleMesh& mesh,
                  const std::vector<Vector3d>& normals,
                  const std::vector<double>& areas,
                  double side) {
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  Eigen::Matrix<double, 6, 6> A = 1e-9 * Eigen::Matrix<double, 6, 6>::Identity();
  Vector6 b = Vector6::Zero();
  const double w = tibia.plateau.width;
  for (std::size_t i = 0; i < areas.size(); ++i) {
    const Vector3d q = tibia.frame.components(mesh.vertices[i] - tibia.frame.origin) / w;
    const double x = q.x(), z = q.z() - 0.26 * side;
    if (std::abs(z) > 0.12 || std::abs(x) > 0.22 || std::abs(q.y()) > 0.2 ||
        normals[i].dot(tibia.frame.proximal) < 0.6)
      continue;
    Vector6 row;
    row << 1, x, z, x * x, x * z, z * z;
    A += areas[i] * row * row.transpose();
    b += areas[i] * q.y() * row;
  }
  return 2 * symmetric_solution(A, b)(3);
}

/// How much farther the bone below the plateau reaches laterally than medially, of the plateau's width: head
/// of the fibula, or the lateral condyle's overhang above it.
double reach_below(const TibialShape& tibia, const TriangleMesh& mesh) {
  double low = 0, high = 0;
  for (const Vector3d& p : mesh.vertices) {
    const Vector3d q = tibia.frame.components(p - tibia.frame.origin) / tibia.plateau.width;
    if (q.y() > -0.15 || q.y() < -0.6) continue;
    low = std::min(low, q.z());
    high = std::max(high, q.z());
  }
  return high + low;
}

}  // namespace

std::vector<SideEvidence> weigh_femur(const FemoralShape& femur) {
  constexpr Feature kLean{6.5 * M_PI / 180, 3.5 * M_PI / 180, 4};
  constexpr Feature kTrochlea{0.04, 0.025, 3}, kDistal{0.022, 0.015, 3}, kRadii{0.13, 0.12, 2};
  std::vector<SideEvidence> found;
  if (femur.shaft > 0)
    found.push_back({"femoral shaft leans laterally", femur.lean * 180 / M_PI, "degrees",
                     log_ratio(kLean, femur.lean)});
  const double trochlea = lateral_reach_ahead(femur, M_PI / 2);
  found.push_back(
      {"trochlea higher laterally", trochlea * femur.width, "mm", log_ratio(kTrochlea, trochlea)});
  const double distal = -lateral_reach_ahead(femur, 0);
  found.push_back(
      {"medial condyle more distal", distal * femur.width, "mm", log_ratio(kDistal, distal)});
  const double radii = std::log(femur.axis.medial_radius / femur.axis.lateral_radius);
  found.push_back({"medial condyle larger", 100 * radii, "%", log_ratio(kRadii, radii)});
  return found;
}

std::vector<SideEvidence> weigh_tibia(const TibialShape& tibia, const TriangleMesh& mesh) {
  constexpr Feature kHollow{1.8, 1.0, 4}, kDepth{0.11, 0.09, 2}, kBelow{0.03, 0.025, 3};
  const std::vector<Vector3d> normals = vertex_normals(mesh);
  const std::vector<double> areas = vertex_areas(mesh);
  std::vector<SideEvidence> found;
  const double hollow =
      hollowness(tibia, mesh, normals, areas, -1) - hollowness(tibia, mesh, normals, areas, 1);
  found.push_back({"medial plateau more hollow from front to back",
                   1000 * hollow / tibia.plateau.width, "per m", log_ratio(kHollow, hollow)});
  if (const double ratio = plateau_depth_ratio(mesh, tibia.frame); ratio > 0)
    found.push_back(
        {"medial plateau deeper", 100 * std::log(ratio), "%", log_ratio(kDepth, std::log(ratio))});
  if (const double below = reach_below(tibia, mesh); below != 0)
    found.push_back({"farther laterally below the plateau", below * tibia.plateau.width, "mm",
                     log_ratio(kBelow, below)});
  return found;
}

}  // namespace condyle
