#pragma once

/// Links what lies on either side of a mesh's seams (mesh_seams.h).

#include "condyle/mesh/triangle_mesh.h"

namespace condyle {

struct WeldedSeams {
  double length = 0;  ///< that there were [mm]
  double joined = 0;  ///< of it, of which both sides are linked now [mm]
};

/// Links both sides of the seams: vertices within 0.3 of an edge, and of the least height of their triangles, become one in
/// their middle; others divide the edge that they lie on, where no part of its triangle turns over. Nothing is done, and
/// nothing told, where seams are shorter than four mean edges altogether.
WeldedSeams weld_seams(TriangleMesh& mesh);

}  // namespace condyle
