#pragma once

/// Stability of a position of equilibrium: the lowest eigenvalue of the tangent stiffness reduced
/// to the motions that the closed contacts and the conditions admit. Rotations count as L dπ, so
/// the value is in N/mm.

#include <Eigen/Core>

#include <string>

#include "condyle/equilibrium/newton.h"

namespace condyle {

/// Motions as columns (da, L dπ); never allocates.
using Motions = Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, 6>;

struct Stability {
  double lowest_stiffness;             ///< [N/mm]; infinite where no motion is left
  Eigen::Matrix<double, 6, 1> motion;  ///< (da, L dπ), unit: the softest admissible motion
  bool neutral = false;    ///< nothing resists that motion: below 1e-9 of the largest stiffness
  bool dependent = false;  ///< contacts and conditions prevent some motion more than once
  Motions free;            ///< all motions that nothing resists, orthonormal; empty unless neutral
  [[nodiscard]] bool stable() const { return lowest_stiffness > 0 && !neutral; }
};

/// `system` assembled at the position of equilibrium. The stiffness is -(∂wrench/∂pose), its
/// symmetric part: follower loads have no potential.
[[nodiscard]] Stability stability(const Model& model, const NewtonSystem& system);

/// "" where the pose is stable, else which motion is free or grows by itself; and which contacts
/// and conditions share what they carry in a way that statics cannot tell.
[[nodiscard]] std::string stability_remark(const Model& model,
                                           const NewtonSystem& system,
                                           const RigidTransform& X_BA,
                                           const Stability& stability);

/// The direction (n, s x n/L) of a closed contact or (α, η/L) of a condition, as a unit vector:
/// contacts come first. What they prevent is a motion along it.
[[nodiscard]] Eigen::Matrix<double, 6, 1> constraint_direction(const Model& model,
                                                               const NewtonSystem& system,
                                                               std::size_t constraint);

/// An orthonormal basis of the motions that no contact and no condition prevents.
[[nodiscard]] Motions admissible_motions(const Model& model, const NewtonSystem& system);

}  // namespace condyle
