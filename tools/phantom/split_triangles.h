#pragma once

/// Finer meshes of the same surface, for measuring what large files cost.

#include "condyle/mesh/triangle_mesh.h"

namespace condyle::phantom {

/// Each triangle cut into four at the middles of its edges, `times` over. Neighbours share
/// vertices.
[[nodiscard]] TriangleMesh split_triangles(TriangleMesh mesh, int times);

}  // namespace condyle::phantom
