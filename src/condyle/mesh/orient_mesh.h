#pragma once

/// Components of a mesh and their orientation.

#include <vector>

#include "condyle/mesh/mesh_edges.h"
#include "condyle/mesh/triangle_mesh.h"

namespace condyle {

/// Number of the component of each triangle, by falling area; linked through edges of just two
/// triangles.
[[nodiscard]] std::vector<int> find_components(const TriangleMesh& mesh,
                                               const TriangleLinks& links);

/// Turns triangles so that each component is consistent in itself (the fewest are turned) and
/// closed components face out of the solid: outward, but for the wall of a cavity, a component within another one whose
/// triangles face the other way in the file. Returns how many triangles end up turned; fills `closed` per
/// component.
int orient_components(TriangleMesh& mesh,
                      const TriangleLinks& links,
                      const std::vector<int>& component,
                      std::vector<bool>& closed);

}  // namespace condyle
