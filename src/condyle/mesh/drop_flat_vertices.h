#pragma once

/// The same shape with fewer vertices. A vertex in the middle of a plane or of a straight crease
/// tells nothing about the surface that a mesh samples, but would count as a point of it: a mesh
/// whose triangles were cut into smaller ones shall be the mesh that it was before.

#include "condyle/mesh/triangle_mesh.h"

namespace condyle {

struct FlatVertexOptions {
  double tolerance = 2e-5;  ///< how far from the new triangles a vertex may lie that goes: what
                            ///< single precision makes of a knee's coordinates [mm]
  double longest_edge = 3;  ///< that may come about [mm]
};

/// Pulls such vertices, one by one, onto the nearest neighbour that will do; the rest keep their places and order.
[[nodiscard]] TriangleMesh drop_flat_vertices(TriangleMesh mesh,
                                              const FlatVertexOptions& options = {});

}  // namespace condyle
