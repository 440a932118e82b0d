#pragma once

/// A triangle mesh as a PLY file.

#include <string>

#include "condyle/mesh/triangle_mesh.h"

namespace condyle {

/// ASCII, in mm, each number with the digits that give back the same bits.
[[nodiscard]] std::string ply(const TriangleMesh& mesh);

}  // namespace condyle
