#pragma once

/// Exact surfaces: plane, sphere, cylinder, ellipsoid, torus and height polynomial. A place on one
/// is the point itself, so no chart has a pole. `solid_inside` says on which side of a closed kind
/// the solid lies. Plane, cylinder and polynomial go on for ever unless a bound is given; beyond it
/// they go on as well, but count as unknown (Surface::edge_distance).

#include <limits>
#include <memory>
#include <vector>

#include "condyle/surface/surface.h"

namespace condyle {

inline constexpr double kUnbounded = std::numeric_limits<double>::infinity();

/// Plane through `point`, known within `radius` of it; `normal` points out of the solid.
[[nodiscard]] std::unique_ptr<Surface> make_plane(const Eigen::Vector3d& point,
                                                  const Eigen::Vector3d& normal,
                                                  double radius = kUnbounded);
[[nodiscard]] std::unique_ptr<Surface> make_sphere(const Eigen::Vector3d& center,
                                                   double radius,
                                                   bool solid_inside);
/// Circular cylinder about the axis through `point`, half its `length` to either side of it.
[[nodiscard]] std::unique_ptr<Surface> make_cylinder(const Eigen::Vector3d& point,
                                                     const Eigen::Vector3d& axis,
                                                     double radius,
                                                     bool solid_inside,
                                                     double length = kUnbounded);
/// Columns of `axes` are the directions of the semi-axes.
[[nodiscard]] std::unique_ptr<Surface> make_ellipsoid(const Eigen::Vector3d& center,
                                                      const Eigen::Matrix3d& axes,
                                                      const Eigen::Vector3d& semi_axes,
                                                      bool solid_inside);
/// Ring torus, minor < major.
[[nodiscard]] std::unique_ptr<Surface> make_torus(const Eigen::Vector3d& center,
                                                  const Eigen::Vector3d& axis,
                                                  double major,
                                                  double minor,
                                                  bool solid_inside);

struct PolynomialTerm {
  int i, j;  ///< exponents of x and y, >= 0
  double a;  ///< coefficient [mm^(1-i-j)]
};
/// Height z = Σ a x^i y^j over the plane through `origin`; columns of `axes` are x, y and the
/// height direction. The solid lies below (`solid_inside`) or above. Known where x² + y² <=
/// radius².
[[nodiscard]] std::unique_ptr<Surface> make_polynomial(const Eigen::Vector3d& origin,
                                                       const Eigen::Matrix3d& axes,
                                                       const std::vector<PolynomialTerm>& terms,
                                                       bool solid_inside,
                                                       double radius = kUnbounded);

}  // namespace condyle
