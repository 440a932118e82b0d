#pragma once

/// Force and moment on the moving body A, about its origin O_A, with their derivatives with respect
/// to a motion (da, dπ) of A: da translation of O_A [mm], dπ rotation vector in the ground frame
/// [rad], R <- exp([dπ]x) R. The blocks are those of the Newton system [Dortmans 1986, 2.156].

#include <Eigen/Core>

namespace condyle {

struct Wrench {
  Eigen::Vector3d f = Eigen::Vector3d::Zero();   ///< [N], ground frame
  Eigen::Vector3d m = Eigen::Vector3d::Zero();   ///< [N mm], about O_A, ground frame
  Eigen::Matrix3d F1 = Eigen::Matrix3d::Zero();  ///< ∂f/∂a [N/mm]
  Eigen::Matrix3d F2 = Eigen::Matrix3d::Zero();  ///< ∂f/∂π [N/rad]
  Eigen::Matrix3d M1 = Eigen::Matrix3d::Zero();  ///< ∂m/∂a [N]
  Eigen::Matrix3d M2 = Eigen::Matrix3d::Zero();  ///< ∂m/∂π [N mm/rad]
};

/// (f, m/L) [N], L [mm].
[[nodiscard]] Eigen::Matrix<double, 6, 1> scaled_wrench(const Wrench& w, double L);

/// -∂(f, m/L) with respect to (da, L dπ) [N/mm], L [mm]: the tangent stiffness with rotations as
/// lengths. Symmetric at equilibrium for loads that have a potential.
[[nodiscard]] Eigen::Matrix<double, 6, 6> scaled_stiffness(const Wrench& w, double L);

}  // namespace condyle
