#include "surface/bone_check.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "input_error.h"
#include "mesh/clean_mesh.h"
#include "mesh/mesh_measures.h"
#include "surface/articular_region.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

constexpr double kWidest = 125;    // of a knee; epicondylar widths of men are 83 +- 4 [mm]
constexpr double kGoodAxis = 1.5;  // rms of posterior condyles from their cylinders [mm]

std::optional<CondylarAxis> find_axis(const TriangleMesh& mesh, const BoneFrame& frame) {
  CleanMesh turned = clean_mesh(mesh);
  face_out_of_femur(turned);
  try {
    return fit_condylar_axis(turned.mesh, vertex_normals(turned.mesh), frame);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

}  // namespace

void check_one_knee(const TriangleMesh& mesh, const BoneFrame& frame) {
  double low = 1e300, high = -1e300;
  for (const Vector3d& p : mesh.vertices) {
    low = std::min(low, frame.lateral.dot(p));
    high = std::max(high, frame.lateral.dot(p));
  }
  if (high - low > kWidest)
    throw InputError(
        fmt::format("the mesh is {:.0f} mm wide from medial to lateral, expected at most {:.0f} "
                    "mm: two knees in "
                    "one file, or a wrong unit",
                    high - low, kWidest));
}

void check_is_no_femur(const TriangleMesh& mesh, const BoneFrame& frame) {
  const std::optional<CondylarAxis> axis = find_axis(mesh, frame);
  if (!axis || axis->rms > kGoodAxis || axis->coverage < 0.8) return;
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
  // From front to back over the middle of each half, of what faces upwards near the top.
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
  std::array<double, 2> low = {1e300, 1e300}, high = {-1e300, -1e300};
  for (const Vector3d& p : points) {
    const double share = (p.z() - upper.min().z()) / upper.sizes().z();
    if (share > 0.4 && share < 0.6) continue;
    const std::size_t half = share > 0.5;
    low[half] = std::min(low[half], p.x());
    high[half] = std::max(high[half], p.x());
  }
  return (high[0] - low[0]) / std::max(high[1] - low[1], 1e-9);
}

}  // namespace condyle
