#pragma once

/// A rigid body as a component with k + 1 ports [Tokad 1992, 13-15, 35-45]. Port j has the twist
/// x_j = (v_j, ω) and takes in the wrench y_j = (f_j, M_j), both in the ground frame; the reference
/// port 0 may lie anywhere on the body:
///
///     [ x   ]   [ 0   Kᵀ       ] [ y   ]   [ 0 ]
///     [ y_0 ] = [-K   P d/dt   ] [ x_0 ] + [ Q + u ]
///
/// Without mass (P, Q, u left out) the matrix is skew-symmetric: an ideal transformer, which takes
/// in no power.

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <vector>

#include "condyle/math/rigid_transform.h"
#include "condyle/network/mass_properties.h"

namespace condyle {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// K_j for the arm r_0j: carries a wrench from port j to the reference port; its transpose carries
/// the twist of the reference port to port j.
[[nodiscard]] Matrix6 carrier(const Eigen::Vector3d& arm);

/// K_j y without the matrix.
[[nodiscard]] inline Vector6 wrench_at_reference(const Vector6& y, const Eigen::Vector3d& arm) {
  Vector6 moved = y;
  moved.tail<3>() += arm.cross(y.head<3>());
  return moved;
}

/// The matrix of the massless body with ports at these arms: (x_1 .. x_k, y_0) from
/// (y_1 .. y_k, x_0). Never built by the equations, which carry each port by itself: tests compare.
[[nodiscard]] Eigen::MatrixXd hybrid_matrix(const std::vector<Eigen::Vector3d>& arms);

/// The terms of W x_0 + u = P dx_0/dt + Q + u at a pose, for the reference port at `reference`
/// (body frame).
struct InertiaTerms {
  Matrix6 P;
  Vector6 Q;            ///< of the velocities
  Vector6 u;            ///< of gravity
  Eigen::Vector3d arm;  ///< r_0G, ground frame [mm]
};
[[nodiscard]] InertiaTerms inertia_terms(const MassProperties& mass,
                                         const Eigen::Vector3d& reference,
                                         const Eigen::Matrix3d& R,
                                         const Vector6& x_0,
                                         const Eigen::Vector3d& gravity);

/// P⁻¹ for the mass centre at `arm` from the reference port (ground frame), from J_G⁻¹ in the
/// body's frame: no factorization of P, and no loss of digits where the port is far from the
/// centre.
[[nodiscard]] Matrix6 inverse_inertia(double mass,
                                      const Eigen::Matrix3d& inverse_J,
                                      const Eigen::Matrix3d& R,
                                      const Eigen::Vector3d& arm);

/// dP/dt: with it x_0.(Q - dP/dt x_0 / 2) = 0 [Tokad 1992, 48], which tests ask of Q.
[[nodiscard]] Matrix6 inertia_rate(const MassProperties& mass,
                                   const Eigen::Vector3d& reference,
                                   const Eigen::Matrix3d& R,
                                   const Eigen::Vector3d& omega);

}  // namespace condyle
