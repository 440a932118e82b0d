#include "condyle/surface/mesh_distance.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>

#include "condyle/mesh/point_tree.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

Vector3d on_segment(const Vector3d& p, const Vector3d& a, const Vector3d& b) {
  const Vector3d ab = b - a;
  return a + std::clamp(ab.dot(p - a) / std::max(ab.squaredNorm(), 1e-300), 0.0, 1.0) * ab;
}

/// Where the perpendicular meets it, if that is inside, else the nearest point of the edges.
Vector3d on_triangle(const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d n = (b - a).cross(c - a);
  const double area = n.squaredNorm();
  const bool above = area > 0 && n.dot((b - a).cross(p - a)) >= 0 &&
                     n.dot((c - b).cross(p - b)) >= 0 && n.dot((a - c).cross(p - c)) >= 0;
  if (above) return p - n.dot(p - a) / area * n;
  Vector3d nearest = on_segment(p, a, b);
  for (const Vector3d& other : {on_segment(p, b, c), on_segment(p, c, a)})
    if ((other - p).squaredNorm() < (nearest - p).squaredNorm()) nearest = other;
  return nearest;
}

}  // namespace

struct MeshDistance::Index {
  PointCloud cloud;
  PointTree tree;
  std::vector<int> first, around;  ///< triangles of vertex v: around[first[v]] to [first[v + 1]]

  explicit Index(const TriangleMesh& mesh)
      : cloud{mesh.vertices},
        tree(3, cloud),
        first(mesh.vertices.size() + 2, 0),
        around(3 * mesh.triangles.size()) {
    // Counted two places on, so that filling moves each beginning to where it belongs.
    for (const auto& triangle : mesh.triangles)
      for (const int v : triangle) ++first[v + 2];
    for (std::size_t v = 2; v < first.size(); ++v) first[v] += first[v - 1];
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for (const int v : mesh.triangles[t]) around[first[v + 1]++] = static_cast<int>(t);
  }
};

MeshDistance::MeshDistance(const TriangleMesh& mesh)
    : mesh_(mesh), index_(std::make_unique<Index>(mesh)) {}
MeshDistance::~MeshDistance() = default;

Vector3d MeshDistance::closest(const Vector3d& p) const {
  constexpr std::size_t kNearest = 4;
  std::array<std::size_t, kNearest> vertices{};
  std::array<double, kNearest> square{};
  nanoflann::KNNResultSet<double> result(kNearest);
  result.init(vertices.data(), square.data());
  index_->tree.findNeighbors(result, p.data(), nanoflann::SearchParams());
  Vector3d nearest = mesh_.vertices[vertices[0]];
  for (std::size_t k = 0; k < result.size(); ++k)
    for (int i = index_->first[vertices[k]]; i < index_->first[vertices[k] + 1]; ++i) {
      const auto& [a, b, c] = mesh_.triangles[index_->around[i]];
      const Vector3d point =
          on_triangle(p, mesh_.vertices[a], mesh_.vertices[b], mesh_.vertices[c]);
      if ((point - p).squaredNorm() < (nearest - p).squaredNorm()) nearest = point;
    }
  return nearest;
}

}  // namespace condyle
