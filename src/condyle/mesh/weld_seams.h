#pragma once

/// Links what lies on either side of a mesh's seams (mesh_seams.h).

#include <string>

#include "condyle/mesh/triangle_mesh.h"

namespace condyle {

struct WeldedSeams {
  double length = 0;  ///< that there were [unit of the mesh]
  double joined = 0;  ///< of it, of which both sides are linked now [unit of the mesh]
};

/// Links both sides of the seams: vertices within 0.3 of an edge, and of the least height of their triangles, become one in
/// their middle; others divide the edge that they lie on, where no part of its triangle turns over. Nothing is done, and
/// nothing told, where seams are shorter than four mean edges altogether.
WeldedSeams weld_seams(TriangleMesh& mesh);

/// What a person should know of them, one line. `to_mm`: the unit of the mesh in mm.
[[nodiscard]] std::string describe(const WeldedSeams& seams, double to_mm = 1);

}  // namespace condyle
