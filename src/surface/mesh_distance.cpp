#include "surface/mesh_distance.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>

#include "surface/point_tree.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

double square_to_segment(const Vector3d& p, const Vector3d& a, const Vector3d& b) {
  const Vector3d ab = b - a, ap = p - a;
  const double t = std::clamp(ap.dot(ab) / std::max(ab.squaredNorm(), 1e-300), 0.0, 1.0);
  return (ap - t * ab).squaredNorm();
}

/// The foot of the perpendicular where it falls inside, else the nearest edge.
double square_to_triangle(const Vector3d& p,
                          const Vector3d& a,
                          const Vector3d& b,
                          const Vector3d& c) {
  const Vector3d n = (b - a).cross(c - a);
  const double area = n.squaredNorm();
  const bool above = area > 0 && n.dot((b - a).cross(p - a)) >= 0 &&
                     n.dot((c - b).cross(p - b)) >= 0 && n.dot((a - c).cross(p - c)) >= 0;
  if (above) {
    const double height = n.dot(p - a);
    return height * height / area;
  }
  return std::min(
      {square_to_segment(p, a, b), square_to_segment(p, b, c), square_to_segment(p, c, a)});
}

}  // namespace

struct MeshDistance::Index {
  PointCloud cloud;
  PointTree tree;
  std::vector<std::vector<int>> around;  ///< triangles of each vertex

  explicit Index(const TriangleMesh& mesh)
      : cloud{mesh.vertices}, tree(3, cloud), around(mesh.vertices.size()) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for (const int v : mesh.triangles[t]) around[v].push_back(static_cast<int>(t));
  }
};

MeshDistance::MeshDistance(const TriangleMesh& mesh)
    : mesh_(mesh), index_(std::make_unique<Index>(mesh)) {}
MeshDistance::~MeshDistance() = default;

double MeshDistance::operator()(const Vector3d& p) const {
  constexpr std::size_t kNearest = 4;
  std::array<std::size_t, kNearest> nearest{};
  std::array<double, kNearest> square{};
  nanoflann::KNNResultSet<double> result(kNearest);
  result.init(nearest.data(), square.data());
  index_->tree.findNeighbors(result, p.data(), nanoflann::SearchParams());
  double least = square[0];
  for (std::size_t k = 0; k < result.size(); ++k)
    for (const int t : index_->around[nearest[k]]) {
      const auto& [a, b, c] = mesh_.triangles[t];
      least = std::min(
          least, square_to_triangle(p, mesh_.vertices[a], mesh_.vertices[b], mesh_.vertices[c]));
    }
  return std::sqrt(least);
}

}  // namespace condyle
