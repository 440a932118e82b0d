#pragma once

/// Stability of a position of equilibrium: the lowest eigenvalue of the tangent stiffness reduced
/// to the motions that the closed contacts and the conditions admit. Rotations count as L dπ, so
/// the value is in N/mm.

#include <Eigen/Core>

#include <string>

#include "condyle/equilibrium/admissible_motions.h"

namespace condyle {

struct Stability {
  double lowest_stiffness;             ///< [N/mm]; infinite where no motion is left
  Eigen::Matrix<double, 6, 1> motion;  ///< (da, L dπ), unit: the softest admissible motion
  bool neutral = false;    ///< nothing resists that motion: below 1e-9 of the largest stiffness
  bool dependent = false;  ///< contacts and conditions prevent some motion more than once
  Motions free;            ///< all motions that nothing resists, orthonormal; empty unless neutral
  [[nodiscard]] bool stable() const { return lowest_stiffness > 0 && !neutral; }
};

/// At a position of equilibrium. The stiffness is -(∂wrench/∂pose), its symmetric part: follower
/// loads have no potential.
[[nodiscard]] Stability stability(const Linearization& at);

/// "" where the pose is stable, else which motion is free or grows by itself; and which contacts
/// and conditions share what they carry in a way that statics cannot tell.
[[nodiscard]] std::string stability_remark(const Linearization& at, const Stability& stability);

}  // namespace condyle
