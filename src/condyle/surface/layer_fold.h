#pragma once

/// Where a layer that reaches into a solid is thicker than the solid's surface allows: beyond a
/// radius of curvature of a convex place its lower side has folded over, and the points in it have
/// no one closest point on the surface.

#include "condyle/surface/surface.h"

namespace condyle {

struct LayerFold {
  double area = 0;          ///< of the known part where the layer folds over [mm²]
  double known = 0;         ///< of all of the known part [mm²]
  double least_radius = 0;  ///< of its convex places [mm], infinite where there are none
  Eigen::Vector3d where = Eigen::Vector3d::Zero();  ///< the place of that radius [mm]

  /// 0 where nothing is known.
  [[nodiscard]] double share() const { return known > 0 ? area / known : 0; }
};

/// Of a layer of this thickness [mm] on the known part of a surface, looked at about every 0.5 mm.
/// Nothing is known of a surface without bounds.
[[nodiscard]] LayerFold layer_fold(const Surface& surface, double thickness);

}  // namespace condyle
