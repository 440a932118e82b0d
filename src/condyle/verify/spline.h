#pragma once

/// A tensor-product B-spline by de Boor's algorithm [de Boor 1978], from the datasets of
/// /patches/SURFACE alone.

#include <Eigen/Core>

#include "condyle/surface/patch.h"

namespace condyle::verification {

/// Point and derivatives [mm, per unit of parameter].
struct SplinePoint {
  Eigen::Vector3d c, c_u, c_v, c_uu, c_uv, c_vv;
};

/// (u, v) is brought into the parameter box first.
[[nodiscard]] SplinePoint spline_point(const PatchData& patch, double u, double v);

/// The parameter box: [first, last) knots that the basis is complete over.
struct SplineBox {
  double u0, u1, v0, v1;
};
[[nodiscard]] SplineBox spline_box(const PatchData& patch);

/// Distance to the edge of what is known [mm], from the mask; without one from the box.
[[nodiscard]] double mask_distance(const PatchData& patch, double u, double v);

}  // namespace condyle::verification
