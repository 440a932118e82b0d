#pragma once

/// Stability of a position of equilibrium: the lowest eigenvalue of the tangent stiffness reduced
/// to the motions that the closed contacts and the conditions admit. Rotations count as L dπ, so
/// the value is in N/mm.

#include <Eigen/Core>

#include "equilibrium/newton.h"

namespace condyle {

struct Stability {
  double lowest_stiffness;             ///< [N/mm]; infinite where no motion is left
  Eigen::Matrix<double, 6, 1> motion;  ///< (da, L dπ), unit: the softest admissible motion
};

/// `system` assembled at the position of equilibrium. The stiffness is -(∂wrench/∂pose), its
/// symmetric part: follower loads have no potential.
[[nodiscard]] Stability stability(const Model& model, const NewtonSystem& system);

}  // namespace condyle
