#pragma once

/// A region of a mesh, gone on with beyond its limits where the mesh goes on.

#include <vector>

#include "condyle/mesh/triangle_mesh.h"

namespace condyle {

/// The triangles that are kept, and those whose vertices lie within `distance` [mm] of them, along
/// the edges of the mesh and over vertices that `may` be taken alone.
[[nodiscard]] std::vector<bool> grow_region(const TriangleMesh& mesh,
                                            const std::vector<bool>& keep,
                                            const std::vector<bool>& may,
                                            double distance);

}  // namespace condyle
