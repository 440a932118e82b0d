#pragma once

/// Edges of a triangle mesh, and what lies across them.

#include <array>
#include <vector>

#include "condyle/mesh/triangle_mesh.h"

namespace condyle {

/// One edge, once, and the triangles that share it.
struct MeshEdge {
  int a = 0, b = 0;  ///< vertices, a < b
  int count = 0;     ///< triangles that share it: 1 on a boundary, 2 on a manifold
  std::array<int, 2> triangle = {-1, -1};  ///< the first two of them
  std::array<bool, 2> forward = {};        ///< whether the triangle runs from a to b
};
/// By rising a, then b.
[[nodiscard]] std::vector<MeshEdge> mesh_edges(const TriangleMesh& mesh);

/// What lies across each side of each triangle; side k runs from corner k to the next.
class TriangleLinks {
 public:
  explicit TriangleLinks(const TriangleMesh& mesh);

  /// Across side k of triangle t: the one triangle that shares just this edge with it, or -1.
  [[nodiscard]] int across(std::size_t t, std::size_t k) const {
    return links_[t][k] < 0 ? -1 : links_[t][k] / 2;
  }
  /// Whether the two run through their common edge in opposite directions.
  [[nodiscard]] bool agrees(std::size_t t, std::size_t k) const { return links_[t][k] % 2 != 0; }
  /// Whether no other triangle has this edge.
  [[nodiscard]] bool is_boundary(std::size_t t, std::size_t k) const {
    return links_[t][k] == kBoundary;
  }
  [[nodiscard]] std::size_t size() const { return links_.size(); }  ///< triangles
  [[nodiscard]] int boundary_edges() const { return boundary_edges_; }
  [[nodiscard]] int non_manifold_edges() const { return non_manifold_edges_; }

 private:
  static constexpr int kBoundary = -1, kNonManifold = -2;
  std::vector<std::array<int, 3>> links_;  ///< twice the triangle, plus 1 where it agrees
  int boundary_edges_ = 0, non_manifold_edges_ = 0;
};

}  // namespace condyle
