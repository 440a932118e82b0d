#pragma once

/// Articular surfaces as triangle meshes with their normals, for those who show or pass them on:
/// patches cut off at the edge of their data, and the exact kinds.

#include <vector>

#include "condyle/mesh/triangle_mesh.h"
#include "condyle/scene/scene.h"
#include "condyle/surface/patch.h"

namespace condyle {

/// Body frame; neighbouring triangles share their vertices and face out of the solid.
struct SurfaceMesh {
  TriangleMesh mesh;
  std::vector<Eigen::Vector3d> normals;  ///< unit, one for each vertex
  std::vector<Place> places;             ///< of each vertex on its patch; none for the exact kinds
};

/// A patch within its known region, about `spacing` [mm] between vertices. Every vertex lies on the
/// patch and has the patch's own normal.
[[nodiscard]] SurfaceMesh patch_mesh(const Patch& patch, double spacing = 1.2);

/// An exact surface. Of those without bounds a piece of about `extent` [mm] around `near`.
[[nodiscard]] SurfaceMesh exact_mesh(const SurfaceDescription& surface,
                                     const Eigen::Vector3d& near,
                                     double extent = 60);

}  // namespace condyle
