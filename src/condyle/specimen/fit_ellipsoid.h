#pragma once

/// The ellipsoid of least squares of the distances of given points.

#include <vector>

#include "condyle/math/rigid_transform.h"

namespace condyle {

struct EllipsoidFit {
  bool found = false;
  RigidTransform placement;   ///< from the ellipsoid's frame, axes along x, y, z
  Eigen::Vector3d semi_axes;  ///< [mm]
  double rms = 0, max = 0;    ///< of the points' distances [mm]
};

/// Of at least 9 points. `start`: a sphere of that radius at its place, turned as the axes are thought to lie.
[[nodiscard]] EllipsoidFit fit_ellipsoid(const std::vector<Eigen::Vector3d>& points,
                                         const RigidTransform& start,
                                         double radius);

}  // namespace condyle
