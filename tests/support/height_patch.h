#pragma once

/// Patches from a height over a rectangle, for tests and for scenes that nobody drew.

#include <functional>

#include "condyle/surface/bspline_basis.h"
#include "condyle/surface/patch.h"

namespace condyle {

/// Bicubic over [-U, U] x [-V, V] with knots about `knot` apart [mm]; its control points are as high as
/// `height` is at their Greville abscissae [mm].
inline PatchData height_patch(double U,
                              double V,
                              double knot,
                              const std::function<double(double u, double v)>& height) {
  PatchData data;
  data.nu = static_cast<int>(2 * U / knot) + 3;
  data.nv = static_cast<int>(2 * V / knot) + 3;
  data.knots_u = uniform_knots(data.nu, 3, -U, U);
  data.knots_v = uniform_knots(data.nv, 3, -V, V);
  const auto greville = [](const std::vector<double>& knots, int i) {
    const auto k = static_cast<std::size_t>(i);
    return (knots[k + 1] + knots[k + 2] + knots[k + 3]) / 3;
  };
  for (int i = 0; i < data.nu; ++i)
    for (int j = 0; j < data.nv; ++j) {
      const double u = greville(data.knots_u, i), v = greville(data.knots_v, j);
      data.control_points.emplace_back(u, v, height(u, v));
    }
  return data;
}

}  // namespace condyle
