#pragma once

/// Is a point inside a triangle mesh, and how far from it? Winding numbers over a tree of boxes,
/// far triangles as one dipole [Jacobson 2013, Barill 2018].

#include <Eigen/Geometry>

#include <vector>

#include "condyle/mesh/triangle_mesh.h"

namespace condyle::verification {

class Winding {
 public:
  /// The mesh must outlive it and have triangles.
  explicit Winding(const TriangleMesh& mesh);

  /// Has the mesh no rim, but for a share of its edges below 0.1 %?
  [[nodiscard]] bool closed() const { return closed_; }
  /// About ±1 inside, 0 outside; good to 0.05.
  [[nodiscard]] double number(const Eigen::Vector3d& p) const;
  /// To the nearest triangle [mm].
  [[nodiscard]] double distance(const Eigen::Vector3d& p) const;
  [[nodiscard]] const Eigen::AlignedBox3d& box() const { return nodes_[0].box; }

 private:
  struct Node {
    Eigen::AlignedBox3d box;
    Eigen::Vector3d area, middle;  ///< sum of the area vectors [mm²]; mean place by area
    double radius;
    int begin, end, right;  ///< triangles in order_; the left child follows, right < 0: a leaf
  };
  int build(int begin, int end);
  [[nodiscard]] double angle(const Node& node, const Eigen::Vector3d& p) const;

  const TriangleMesh& mesh_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
  bool closed_ = false;
};

}  // namespace condyle::verification
