#pragma once

/// The same shape with fewer vertices. A vertex in the middle of a plane or of a straight crease
/// tells nothing about the surface that a mesh samples, but would count as a point of it: a mesh
/// whose triangles were cut into smaller ones shall be the mesh that it was before.

#include "condyle/mesh/triangle_mesh.h"

namespace condyle {

struct FlatVertexOptions {
  double tolerance = 1e-5;  ///< how far from the new triangles a vertex may lie that goes [mm]
  double longest_edge = 3;  ///< that may come about [mm]
};

/// Pulls such vertices, one by one, onto a neighbour; the rest keep their places and order.
[[nodiscard]] TriangleMesh drop_flat_vertices(TriangleMesh mesh,
                                              const FlatVertexOptions& options = {});

/// Tolerance for coordinates of single precision, about the greatest of the mesh moved by `moved`
/// [mm].
[[nodiscard]] double rounding_of(const TriangleMesh& mesh, const Eigen::Vector3d& moved);

}  // namespace condyle
