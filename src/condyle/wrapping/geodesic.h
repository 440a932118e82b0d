#pragma once

/// Geodesics of a smooth surface with their Jacobi fields, frame of the surface [mm]:
///     dx/ds = t,  dt/ds = κ n,    a'' + G a = 0, a(0) = 1, a'(0) = 0,    r'' + G r = 0, r(0) = 0, r'(0) = 1
/// with G = κ κ_b - τ²: a neighbour that starts shifted by δb along b and turned by δθ from t towards
/// b ends shifted by a δb + r δθ along b.

#include <vector>

#include "condyle/math/rigid_transform.h"
#include "condyle/wrapping/shape_geometry.h"

namespace condyle {

struct Geodesic {
  SurfaceFrame from, to;
  double arc = 0;                       ///< [mm]; negative: backwards from `from`
  double a = 1, da = 0, r = 0, dr = 1;  ///< at `to`; r [mm], da [1/mm]
  /// r does not vanish within the arc: no conjugate point of `from` there.
  bool first_of_kind = true;
  bool presses = true;  ///< the surface curves away from it all along: κ < 0
  bool found = true;    ///< false where the integration gave up
};

/// From a frame on the surface along its t. Sphere and cylinder in closed form, ellipsoid and torus
/// by steps of order 8 to 16, each of which keeps surface and Wronskian to 5e-13.
[[nodiscard]] Geodesic shoot(const WrapShape& shape, const SurfaceFrame& from, double arc);

/// Steps that this thread has taken along geodesics: what paths cost, counted and not timed. Two readings tell
/// what lies between them.
[[nodiscard]] long geodesic_steps();

/// Appends where equal pieces of the arc end, in order, moved by X: for drawing. In
/// such steps, without fields.
void add_points_along(const WrapShape& shape,
                      const SurfaceFrame& from,
                      double arc,
                      int pieces,
                      const RigidTransform& X,
                      std::vector<Eigen::Vector3d>& points);

}  // namespace condyle
