#include "condyle/surface/bone_check.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "condyle/input_error.h"
#include "condyle/mesh/clean_mesh.h"
#include "condyle/mesh/mesh_measures.h"
#include "condyle/surface/face_out.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

constexpr double kWidest = 125;    // of a knee; epicondylar widths of men are 83 +- 4 [mm]
constexpr double kGoodAxis = 1.5;  // rms of posterior condyles from their cylinders [mm]
// Of the width of the bone; the rims of a plateau have radii of 0.13.
constexpr double kMostRadius = 0.32;  // of condyles, of the width: femurs have 0.22 to 0.28
constexpr double kLeastRadius = 0.17;
// Of the radius: a femur goes on above the axis of its condyles; the back of a plateau, which may look like them where the
// shaft is cut off near it, ends by one radius above.
constexpr double kLeastRise = 1.6;

std::optional<CondylarAxis> find_axis(CleanMesh mesh, const BoneFrame& frame) {
  face_out_of_femur(mesh, frame);
  try {
    return fit_condylar_axis(mesh.mesh, vertex_normals(mesh.mesh), frame);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

/// Of the mesh above the axis [mm].
double rise_above(const CondylarAxis& axis, const TriangleMesh& mesh, const BoneFrame& frame) {
  double top = -1e300;
  for (const Vector3d& p : mesh.vertices) top = std::max(top, frame.proximal.dot(p));
  return top - frame.proximal.dot(axis.point);
}

double width_of(const TriangleMesh& mesh, const BoneFrame& frame) {
  double low = 1e300, high = -1e300;
  for (const Vector3d& p : mesh.vertices) {
    low = std::min(low, frame.lateral.dot(p));
    high = std::max(high, frame.lateral.dot(p));
  }
  return high - low;
}

/// From front to back, of what lies at most `below` the highest point [mm]; 0 of no points.
double depth_near_top(const std::vector<Vector3d>& points, double below) {
  double top = -1e300, low = 1e300, high = -1e300;
  for (const Vector3d& p : points) top = std::max(top, p.y());
  for (const Vector3d& p : points) {
    if (p.y() < top - below) continue;
    low = std::min(low, p.x());
    high = std::max(high, p.x());
  }
  return points.empty() ? 0 : high - low;
}

}  // namespace

void check_one_knee(const TriangleMesh& mesh, const BoneFrame& frame) {
  const double width = width_of(mesh, frame);
  if (width > kWidest)
    throw InputError(
        fmt::format("the mesh is {:.0f} mm wide from medial to lateral, expected at most {:.0f} "
                    "mm: two knees in "
                    "one file, or a wrong unit",
                    width, kWidest));
}

void check_is_no_femur(const CleanMesh& mesh, const BoneFrame& frame) {
  const std::optional<CondylarAxis> axis = find_axis(mesh, frame);
  if (!axis || axis->rms > kGoodAxis || axis->coverage < 0.8) return;
  const double radius = std::min(axis->medial_radius, axis->lateral_radius),
               width = width_of(mesh.mesh, frame);
  if (radius < kLeastRadius * width || radius > kMostRadius * width) return;
  if (rise_above(*axis, mesh.mesh, frame) < kLeastRise * radius) return;
  throw InputError(fmt::format(
      "looks like a femur, expected a tibia: it has posterior condyles of radius {:.1f} "
      "and {:.1f} mm about one axis, {:.2f} mm rms",
      axis->medial_radius, axis->lateral_radius, axis->rms));
}

void check_is_femur(const CondylarAxis& axis) {
  if (axis.coverage >= 0.6 && axis.rms < 2 * kGoodAxis) return;
  throw InputError(
      fmt::format("does not look like a femur: posterior condyles fill {:.0f} % of their arcs, "
                  "expected at least "
                  "60 %, and lie {:.2f} mm rms from one axis",
                  100 * axis.coverage, axis.rms));
}

double plateau_depth_ratio(const TriangleMesh& mesh, const BoneFrame& frame) {
  // Of what faces upwards near the top.
  const std::vector<Vector3d> normals = vertex_normals(mesh);
  Eigen::AlignedBox3d box;
  for (const Vector3d& p : mesh.vertices) box.extend(frame.components(p - frame.origin));
  const double top = box.max().y() - 0.4 * box.sizes().z();
  Eigen::AlignedBox3d upper;
  std::vector<Vector3d> points;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Vector3d p = frame.components(mesh.vertices[i] - frame.origin);
    if (p.y() < top || normals[i].dot(frame.proximal) < 0.5) continue;
    points.push_back(p);
    upper.extend(p);
  }
  if (points.empty() || upper.sizes().z() < 1.1 * upper.sizes().x()) return 0;
  // Along the middles of both halves: the eminence lies between them, and a fibular head that is
  // one with the tibia beyond or below them.
  const double width = upper.sizes().z();
  std::array<std::vector<Vector3d>, 2> middle;
  for (const Vector3d& p : points) {
    const double aside = (p.z() - upper.center().z()) / width;
    if (std::abs(std::abs(aside) - 0.25) < 0.1) middle[aside > 0].push_back(p);
  }
  const double lateral = depth_near_top(middle[1], 0.15 * width);
  return lateral > 0 ? depth_near_top(middle[0], 0.15 * width) / lateral : 0;
}

}  // namespace condyle
