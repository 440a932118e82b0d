#pragma once

/// Exact surfaces laid out in charts: what is summed over them takes their cells. Lengths in mm.

#include <Eigen/Core>

#include <functional>
#include <vector>

#include "condyle/surface/surface.h"

namespace condyle {

/// A rectangle of (u, v), measured so that ways on the surface are no longer than those in it.
struct SurfaceChart {
  struct At {
    Eigen::Vector3d c;  ///< point [mm]
    double stretch;     ///< |c_u x c_v|
  };
  double u_min = 0, u_max = 0, v_min = 0, v_max = 0;  ///< [mm]
  std::function<At(double u, double v)> at;
};

class ExactSurface : public Surface {
 public:
  /// Charts that cover the surface once; those of a plane or a polynomial reach beyond its known
  /// part, into the corners of a square. None for a surface without bounds.
  [[nodiscard]] virtual std::vector<SurfaceChart> charts() const = 0;
};

/// The faces of a cube about the centre, drawn to the surface.
[[nodiscard]] std::vector<SurfaceChart> ellipsoid_charts(const Eigen::Vector3d& center,
                                                         const Eigen::Matrix3d& axes,
                                                         const Eigen::Vector3d& semi_axes);

}  // namespace condyle
