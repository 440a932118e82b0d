#pragma once

/// Vertices that coincide become one, so that triangles know their neighbours (STL has none).

#include "condyle/mesh/triangle_mesh.h"

namespace condyle {

/// Merges vertices closer than `tolerance` [mm] to an earlier one; returns how many were dropped. One that is no number is near
/// none.
int merge_vertices(TriangleMesh& mesh, double tolerance);

/// Drops vertices that no triangle uses; returns how many.
int drop_unreferenced_vertices(TriangleMesh& mesh);

}  // namespace condyle
