#pragma once

/// Seams of a mesh: where two sheets of it run along each other and share no edges, as a crack narrower than its triangles
/// or a row of vertices on one side only leaves them. What lies beyond a seam is not linked with the rest.

#include "condyle/mesh/triangle_mesh.h"

namespace condyle {

/// Length [mm] of the boundary beside which other boundary runs on its far side, within 0.3 of an edge's length.
[[nodiscard]] double seam_length(const TriangleMesh& mesh);

/// Links both sides of the seams: vertices within 0.3 of an edge become one, others divide the edge that they lie on. Returns
/// the length of the seams [mm]; nothing is done where they are shorter than 5 mm altogether, as slits of pinholes are.
double weld_seams(TriangleMesh& mesh);

}  // namespace condyle
