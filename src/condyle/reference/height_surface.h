#pragma once

/// An articular surface as Wismans describes it: a height over a plane, a polynomial of two
/// coordinates, z = Σ a_ij x^i y^j. The two coordinates are unknowns of the model. Lengths in mm,
/// in the frame of the body that carries the surface.

#include <Eigen/Core>

#include <vector>

#include "condyle/surface/exact_surfaces.h"

namespace condyle {

struct HeightSurface {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< columns: x, y, height
  std::vector<PolynomialTerm> terms;
  bool solid_below = true;  ///< on which side of the surface the solid lies
  /// Convex outline of the points that the polynomial stands for, counter-clockwise in (x, y);
  /// empty: known everywhere.
  std::vector<Eigen::Vector2d> outline;
};

/// All that the equations and their derivatives ask for at one pair of coordinates.
struct HeightPoint {
  Eigen::Vector3d c;           ///< point
  Eigen::Vector3d t[2];        ///< ∂c/∂x, ∂c/∂y
  Eigen::Vector3d c_xx[2][2];  ///< second derivatives of c
  Eigen::Vector3d n;           ///< unit normal, out of the solid
  Eigen::Vector3d n_x[2];      ///< ∂n/∂x, ∂n/∂y
};
[[nodiscard]] HeightPoint evaluate(const HeightSurface& surface, const Eigen::Vector2d& at);

/// Distance in the plane from (x, y) to the outline [mm], negative beyond it.
[[nodiscard]] double distance_to_outline(const HeightSurface& surface, const Eigen::Vector2d& at);

/// Coordinates of the place above or below the point p.
[[nodiscard]] Eigen::Vector2d coordinates_of(const HeightSurface& surface,
                                             const Eigen::Vector3d& p);

/// The convex hull of points, counter-clockwise.
[[nodiscard]] std::vector<Eigen::Vector2d> convex_outline(std::vector<Eigen::Vector2d> points);

/// Coordinates of a square grid over the outline [mm]; about the origin where there is none.
[[nodiscard]] std::vector<Eigen::Vector2d> grid_within(const HeightSurface& surface,
                                                       double spacing);

}  // namespace condyle
