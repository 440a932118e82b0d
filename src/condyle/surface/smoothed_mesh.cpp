#include "condyle/surface/smoothed_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "condyle/mesh/mesh_measures.h"
#include "condyle/mesh/point_tree.h"

namespace condyle {

using Eigen::Vector3d;

struct SmoothedMesh::Index {
  PointCloud cloud;
  PointTree tree;
  explicit Index(const TriangleMesh& mesh) : cloud{mesh.vertices}, tree(3, cloud) {}
};

SmoothedMesh::SmoothedMesh(const TriangleMesh& mesh, double smoothing)
    : mesh_(mesh),
      h_(std::max(smoothing, mean_edge_length(mesh))),
      normals_(vertex_normals(mesh)),
      areas_(vertex_areas(mesh)),
      distance_(mesh),
      index_(std::make_unique<Index>(mesh)) {}
SmoothedMesh::~SmoothedMesh() = default;

SurfaceHeight SmoothedMesh::height(const Vector3d& p) const {
  constexpr double kReach = 3;  // times h
  const double least = std::exp(-kReach * kReach);
  const Vector3d q = distance_.closest(p);
  const Vector3d& middle = (q - p).squaredNorm() < h_ * h_ ? p : q;
  thread_local std::vector<std::pair<std::uint32_t, double>> found;
  found.clear();
  index_->tree.radiusSearch(middle.data(), kReach * kReach * h_ * h_, found,
                            nanoflann::SearchParams(0, 0, false));
  double sum = 0, own = 0;
  Vector3d center = Vector3d::Zero(), normal = Vector3d::Zero();
  for (const auto& [vertex, square] : found) {
    const double w = areas_[vertex] * (std::exp(-square / (h_ * h_)) - least);
    const Vector3d &at = mesh_.vertices[vertex], &n = normals_[vertex];
    sum += w;
    own += w * n.dot(p - at);
    center += w * at;
    normal += w * n;
  }
  const double length = normal.norm();
  if (!(sum > 0) || !(length > 0)) return {(p - q).norm(), (p - q).normalized()};
  normal /= length;
  return {(normal.dot(p - center / sum) + own / sum) / 2, normal};
}

double SmoothedMesh::signed_distance(const Vector3d& p) const {
  const Vector3d q = distance_.closest(p);
  const double distance = (p - q).norm();
  return height(q).normal.dot(p - q) < 0 ? -distance : distance;
}

}  // namespace condyle
