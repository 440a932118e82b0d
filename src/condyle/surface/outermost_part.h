#pragma once

/// Of sheets of a mesh that lie over each other, as a bone and its cartilage in one file do, the one that faces the other
/// bone.

#include <vector>

#include "condyle/mesh/triangle_mesh.h"

namespace condyle {

/// Triangles of a mesh, and how far another sheet lies below them, or 0 [mm].
struct OutermostPart {
  std::vector<bool> keep;
  double below = 0;
};

/// The linked part of the largest area of the triangles that are kept, of those of a tenth of all or more that no other
/// one covers: whose vertices have another one up to 6 mm off along their normals, two in five of them or more.
[[nodiscard]] OutermostPart outermost_part(const TriangleMesh& mesh, const std::vector<bool>& keep);

}  // namespace condyle
