#pragma once

/// Triangle meshes of the implicit bones: closed, two-manifold, facing outward, every vertex on the
/// exact surface.

#include "condyle/mesh/triangle_mesh.h"
#include "phantom/phantom_shape.h"

namespace condyle::phantom {

/// The grid of the shipped meshes [mm].
inline constexpr double kResolution = 1.4;

/// Surface nets [Gibson 1998] on a grid of `cell` mm, vertices relaxed along the surface and
/// dropped onto it. Where a crevice as narrow as a cell leaves an edge to more than two triangles the
/// grid is moved by parts of a cell until there is none.
[[nodiscard]] TriangleMesh mesh_bone(Bone bone,
                                     double cell,
                                     const PhantomParameters& knee = kShippedPhantom);

}  // namespace condyle::phantom
