#pragma once

/// Plane sections of a bone: the loops that its surface leaves in a plane.

#include <vector>

#include "condyle/mesh/triangle_mesh.h"

namespace condyle {

/// One outline, closed where the mesh is.
struct SectionLoop {
  double area = 0;           ///< positive around bone, negative around a hole in it [mm²]
  Eigen::Vector3d centroid;  ///< of the area it encloses, in the frame of the mesh [mm]
  double length = 0;         ///< of its line [mm]
  double opening = 0;        ///< of what is missing in its line [mm]
};

/// Loops of the section through `at` across the unit vector `along`, the largest first. The mesh faces
/// outward; a loop with small holes, of up to 5 mm, is closed across them.
[[nodiscard]] std::vector<SectionLoop> cross_section(const TriangleMesh& mesh,
                                                     const Eigen::Vector3d& at,
                                                     const Eigen::Vector3d& along);

}  // namespace condyle
