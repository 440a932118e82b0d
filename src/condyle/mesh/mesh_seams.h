#pragma once

/// Seams of a mesh: where two sheets of it run along each other and share no edges, as a crack narrower than its triangles
/// or a row of vertices on one side only leaves them. What lies beyond a seam is not linked with the rest.

#include "condyle/mesh/triangle_mesh.h"

namespace condyle {

/// Length [mm] of the boundary beside which other boundary runs on its far side, within 0.3 of an edge's length.
[[nodiscard]] double seam_length(const TriangleMesh& mesh);

struct WeldedSeams {
  double length = 0;  ///< that there were [mm]
  double joined = 0;  ///< of it, of which both sides are linked now [mm]
};

/// Links both sides of the seams: vertices within 0.3 of an edge, and of the least height of their triangles, become one in
/// their middle; others divide the edge that they lie on, where no part of its triangle turns over. Nothing is done, and
/// nothing told, where seams are shorter than four mean edges altogether.
WeldedSeams weld_seams(TriangleMesh& mesh);

}  // namespace condyle
