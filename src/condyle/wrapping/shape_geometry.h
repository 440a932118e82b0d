#pragma once

/// What a path needs of a smooth surface at a point, frame of the surface [mm]. Normals point out of
/// the solid; the curvature tensor K is that of dn = -K dc, so that a ball has K = -(I - nnᵀ)/r.

#include <Eigen/Core>

#include "condyle/wrapping/wrap_shape.h"

namespace condyle {

/// A point on a surface with the directions of a path: t along it, n out of the solid, b = t x n,
/// and tᵀKt, bᵀKt, bᵀKb [1/mm].
struct SurfaceFrame {
  Eigen::Vector3d x, t, n, b;
  double kappa = 0, tau = 0, kappa_b = 0;
};

/// No normal curvature of the surface there is greater [1/mm].
[[nodiscard]] double largest_curvature(const SurfaceFrame& f);

/// At a point on the surface; the part of `along` in the tangent plane, made unit, becomes t.
[[nodiscard]] SurfaceFrame frame_at(const WrapShape& shape,
                                    const Eigen::Vector3d& on_surface,
                                    const Eigen::Vector3d& along);

/// The same of a t that is tangent and unit to round-off.
[[nodiscard]] SurfaceFrame frame_along(const WrapShape& shape,
                                       const Eigen::Vector3d& on_surface,
                                       const Eigen::Vector3d& t);

[[nodiscard]] Eigen::Vector3d normal_at(const WrapShape& shape, const Eigen::Vector3d& point);

/// A point near the surface moved onto it to round-off, along the normal to first order.
[[nodiscard]] Eigen::Vector3d onto_surface(const WrapShape& shape, const Eigen::Vector3d& point);

/// Signed distance [mm] from the surface, negative inside; exact for every shape.
[[nodiscard]] double signed_distance(const WrapShape& shape, const Eigen::Vector3d& point);

/// The closest point of the surface, exact for every shape also far inside; of several one.
[[nodiscard]] Eigen::Vector3d closest_point(const WrapShape& shape, const Eigen::Vector3d& point);

/// Half the width of the solid where it is narrowest: a radius, the least semi-axis, the tube.
[[nodiscard]] double least_radius(const WrapShape& shape);

/// Are all sizes positive, and has a torus a hole?
[[nodiscard]] bool has_size(const WrapShape& shape);

}  // namespace condyle
