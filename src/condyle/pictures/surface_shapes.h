#pragma once

/// Articular surfaces as shaded meshes: spline patches cut off at the edge of their data, and the
/// exact kinds.

#include <functional>

#include "condyle/pictures/shaded_mesh.h"
#include "condyle/scene/scene.h"
#include "condyle/surface/patch.h"

namespace condyle {

/// A patch within its known region, body frame; about `spacing` [mm] between vertices.
[[nodiscard]] ShadedMesh patch_shape(const Patch& patch, const Paint& paint, double spacing = 1.2);

/// The same with a paint of its own at every point.
[[nodiscard]] ShadedMesh painted_patch(const Patch& patch,
                                       const std::function<Paint(const SurfacePoint&)>& paint,
                                       double spacing);

/// An exact surface, body frame. Those without bounds are drawn as a piece of about `extent` [mm]
/// around `near`.
[[nodiscard]] ShadedMesh exact_shape(const SurfaceDescription& surface,
                                     const Paint& paint,
                                     const Eigen::Vector3d& near,
                                     double extent = 60);

}  // namespace condyle
