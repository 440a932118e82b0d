#pragma once

/// A bone without what lies about it: pieces of other bones, a fabella, calcifications.

#include <Eigen/Core>

#include "condyle/mesh/triangle_mesh.h"

namespace condyle {

struct MainParts {
  TriangleMesh mesh;
  int left_out = 0;  ///< parts
  Eigen::Vector3d middle{0, 0, 0},
      size{0, 0, 0};  ///< of the box of the largest of them, in the mesh's unit
};

/// The linked parts of at least a fifth of the area of the largest one; all of them where those are less than four fifths
/// of all area, as of a mesh that falls into pieces.
[[nodiscard]] MainParts main_parts(const TriangleMesh& mesh);

}  // namespace condyle
