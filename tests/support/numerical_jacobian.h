#pragma once

/// Derivatives by differences, against which the derivatives written by hand are tested.

#include <Eigen/Core>

#include "condyle/math/rigid_transform.h"
#include "condyle/math/rotation.h"

namespace condyle::test {

/// ∂f/∂x at x = 0 by central differences of fourth order: error O(h⁴ f⁗') + O(ε |f| / h). With the
/// scales of a knee h = 1e-3 leaves 10 to 12 digits.
template <int Rows, int Columns, class Function>
Eigen::Matrix<double, Rows, Columns> jacobian_at_zero(const Function& f, double h = 1e-3) {
  using Argument = Eigen::Matrix<double, Columns, 1>;
  Eigen::Matrix<double, Rows, Columns> J;
  for (int j = 0; j < Columns; ++j) {
    const Argument step = h * Argument::Unit(j);
    J.col(j) = (8 * (f(step) - f(-step)) - (f(2 * step) - f(-2 * step))) / (12 * h);
  }
  return J;
}

/// The pose after a motion (da, dπ) of A: O_A moves by da, R <- exp([dπ]x) R.
inline RigidTransform displaced(const RigidTransform& X,
                                const Eigen::Vector3d& da,
                                const Eigen::Vector3d& dpi) {
  return {exp_rotation(dpi) * X.R, X.p + da};
}

/// ∂f/∂a and ∂f/∂π of a vector function f(X) of the pose.
template <class Function>
Eigen::Matrix3d jacobian_of_translation(const Function& f,
                                        const RigidTransform& X,
                                        double h = 1e-3) {
  return jacobian_at_zero<3, 3>(
      [&](const Eigen::Vector3d& da) -> Eigen::Vector3d {
        return f(displaced(X, da, Eigen::Vector3d::Zero()));
      },
      h);
}
template <class Function>
Eigen::Matrix3d jacobian_of_rotation(const Function& f, const RigidTransform& X, double h = 1e-3) {
  return jacobian_at_zero<3, 3>(
      [&](const Eigen::Vector3d& dpi) -> Eigen::Vector3d {
        return f(displaced(X, Eigen::Vector3d::Zero(), dpi));
      },
      h);
}

}  // namespace condyle::test
