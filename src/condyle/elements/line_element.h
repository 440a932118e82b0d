#pragma once

/// A line element from C, fixed to B, to D, fixed to A: it pulls both ends together with f(L)
/// [Dortmans 1986, 2.66-2.84]. d = a + q - x_C, q = R s, e = d/L:  F = -f(L) e on A at D, M = q x F
/// about O_A. Whichever bodies a scene names, C is the end on the fixed one.

#include "condyle/elements/force_law.h"
#include "condyle/elements/wrench.h"
#include "condyle/math/rigid_transform.h"

namespace condyle {

struct LineElement {
  Eigen::Vector3d x_C;  ///< end on the fixed body B, ground frame [mm]
  Eigen::Vector3d s_D;  ///< end on the moving body A, in A's frame [mm]
  ForceLaw law;
};

struct LineElementState {
  double length;  ///< L [mm]
  double force;   ///< f(L) [N], tension positive
  double energy;  ///< [N mm]
};

/// Below this length [mm] the direction of the element is not defined: it then adds nothing and
/// says so by its length, and the solver reports PoseStatus::kZeroLength.
inline constexpr double kLeastLength = 1e-12;

/// Adds the element's wrench on A and its derivatives to `wrench`. Allocates nothing.
LineElementState add_line_element(const LineElement& element,
                                  const RigidTransform& X_BA,
                                  Wrench& wrench);

/// Length, force and energy only.
[[nodiscard]] LineElementState line_element_state(const LineElement& element,
                                                  const RigidTransform& X_BA);

}  // namespace condyle
