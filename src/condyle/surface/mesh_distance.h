#pragma once

/// Distance from points to a triangle mesh.

#include <memory>
#include <vector>

#include "condyle/mesh/triangle_mesh.h"

namespace condyle {

/// Keeps a reference: the mesh must stay as it is, and have a triangle. The triangles around the
/// nearest few vertices are measured, which is exact where triangles are not much longer than wide.
class MeshDistance {
 public:
  explicit MeshDistance(const TriangleMesh& mesh);
  ~MeshDistance();

  [[nodiscard]] double operator()(const Eigen::Vector3d& p) const {
    return (closest(p) - p).norm();
  }
  /// The nearest point of the mesh.
  [[nodiscard]] Eigen::Vector3d closest(const Eigen::Vector3d& p) const;

 private:
  struct Index;
  const TriangleMesh& mesh_;
  std::unique_ptr<Index> index_;
};

}  // namespace condyle
