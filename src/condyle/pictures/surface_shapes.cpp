#include "condyle/pictures/surface_shapes.h"

#include "condyle/specimen/surface_mesh.h"

namespace condyle {

ShadedMesh patch_shape(const Patch& patch, const Paint& paint, double spacing) {
  return painted_patch(
      patch, [&](const SurfacePoint&) { return paint; }, spacing);
}

ShadedMesh painted_patch(const Patch& patch,
                         const std::function<Paint(const SurfacePoint&)>& paint,
                         double spacing) {
  const SurfaceMesh surface = patch_mesh(patch, spacing);
  ShadedMesh shape;
  shape.vertices.reserve(surface.places.size());
  for (const Place& place : surface.places) {
    const SurfacePoint at = patch.evaluate(place);
    shape.vertices.push_back({at.c.cast<float>(), at.n.cast<float>(), bytes(paint(at))});
  }
  shape.triangles.reserve(surface.mesh.triangles.size());
  for (const std::array<int, 3>& t : surface.mesh.triangles)
    shape.triangles.push_back({static_cast<std::uint32_t>(t[0]), static_cast<std::uint32_t>(t[1]),
                               static_cast<std::uint32_t>(t[2])});
  return shape;
}

ShadedMesh exact_shape(const SurfaceDescription& surface,
                       const Paint& paint,
                       const Eigen::Vector3d& near,
                       double extent) {
  return shade(exact_mesh(surface, near, extent).mesh, paint, 0);
}

}  // namespace condyle
