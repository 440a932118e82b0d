#include "condyle/anatomy/knee_ends.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include "condyle/math/decompositions.h"
#include "condyle/mesh/mesh_measures.h"
#include "condyle/mesh/point_tree.h"

namespace condyle {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

struct Moments {
  double area = 0;
  Vector3d first = Vector3d::Zero();
  Matrix3d second = Matrix3d::Zero();

  void add(const Vector3d& p, double weight) {
    area += weight;
    first += weight * p;
    second += weight * p * p.transpose();
  }
  [[nodiscard]] Vector3d middle() const { return first / std::max(area, 1e-300); }
  /// Columns by rising variance.
  [[nodiscard]] Matrix3d principal() const {
    const Vector3d m = middle();
    return symmetric_eigenvalues(second / std::max(area, 1e-300) - m * m.transpose()).vectors;
  }
};

Moments moments_of(const TriangleMesh& mesh) {
  const std::vector<double> areas = vertex_areas(mesh);
  Moments m;
  for (std::size_t i = 0; i < areas.size(); ++i) m.add(mesh.vertices[i], areas[i]);
  return m;
}

/// Distance from each vertex of `mesh` to the nearest one of `other`.
std::vector<double> distances(const TriangleMesh& mesh, const TriangleMesh& other) {
  const PointCloud cloud{other.vertices};
  const PointTree tree(3, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(20));
  std::vector<double> found(mesh.vertices.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    found[i] = std::sqrt(nearest_point(tree, mesh.vertices[i]).square);
  return found;
}

/// Width along `across` of what lies within `reach` of the joint.
double width_there(const TriangleMesh& mesh, const KneeEnds& ends, double reach) {
  double low = 1e300, high = -1e300;
  for (const Vector3d& p : mesh.vertices) {
    if ((p - ends.joint).squaredNorm() > reach * reach) continue;
    low = std::min(low, ends.across.dot(p));
    high = std::max(high, ends.across.dot(p));
  }
  return std::max(high - low, 0.0);
}

}  // namespace

SurfaceExtents surface_extents(const TriangleMesh& mesh) {
  const Moments m = moments_of(mesh);
  const Matrix3d axes = m.principal().rowwise().reverse();
  Eigen::AlignedBox3d box;
  for (const Vector3d& p : mesh.vertices) box.extend(Vector3d(axes.transpose() * (p - m.middle())));
  Vector3d sizes = box.sizes();
  std::sort(sizes.data(), sizes.data() + 3, std::greater<>());
  return {m.middle(), axes, sizes};
}

KneeEnds find_knee_ends(const TriangleMesh& femur, const TriangleMesh& tibia) {
  // What faces the femur, above and below its plane, of the tibia's middle extent; a fibula begins lower.
  constexpr double kAbove = 0.15, kBelow = 0.06;
  constexpr double kReach = 0.9;  // from its middle to its corners, likewise
  const SurfaceExtents whole_femur = surface_extents(femur), whole_tibia = surface_extents(tibia);
  const double size = whole_tibia.sizes[1];
  const std::vector<double> distance = distances(tibia, femur);
  const std::vector<double> areas = vertex_areas(tibia);
  KneeEnds ends;
  ends.gap = *std::min_element(distance.begin(), distance.end());
  Moments zone;
  for (std::size_t i = 0; i < distance.size(); ++i)
    if (distance[i] < ends.gap + kAbove * size) zone.add(tibia.vertices[i], areas[i]);
  // Only one plateau may be near; the slab through it has both.
  for (int iteration = 0; iteration < 4; ++iteration) {
    const double below = iteration == 0 ? kAbove : kBelow;
    ends.joint = zone.middle();
    ends.proximal = zone.principal().col(0);
    if (ends.proximal.dot(whole_femur.middle - whole_tibia.middle) < 0) ends.proximal *= -1;
    zone = Moments{};
    for (std::size_t i = 0; i < areas.size(); ++i) {
      const Vector3d q = tibia.vertices[i] - ends.joint;
      const double height = ends.proximal.dot(q);
      if (height > -below * size && height < kAbove * size && q.norm() < kReach * size)
        zone.add(tibia.vertices[i], areas[i]);
    }
  }
  ends.across = zone.principal().col(2);
  ends.across = (ends.across - ends.proximal * ends.proximal.dot(ends.across)).normalized();
  ends.femur_width = width_there(femur, ends, 0.75 * size);
  ends.tibia_width = width_there(tibia, ends, 0.75 * size);
  return ends;
}

TriangleMesh crop_ball(const TriangleMesh& mesh, const Vector3d& middle, double radius) {
  std::vector<bool> keep(mesh.triangles.size());
  for (std::size_t t = 0; t < keep.size(); ++t) {
    const auto& c = mesh.triangles[t];
    keep[t] = std::all_of(c.begin(), c.end(), [&](int v) {
      return (mesh.vertices[v] - middle).squaredNorm() < radius * radius;
    });
  }
  return sub_mesh(mesh, keep).mesh;
}

}  // namespace condyle
