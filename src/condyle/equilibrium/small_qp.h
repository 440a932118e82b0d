#pragma once

/// A small convex quadratic programme in six variables, for the globalised search of an
/// equilibrium:
///
///     minimise ½ xᵀ H x + gᵀ x   subject to   C x = b,   A x >= d.
///
/// H is made positive definite on the null space of C by taking the magnitudes of its eigenvalues,
/// at least `floor`. Inequalities become a linear complementarity problem in their multipliers,
/// solved by least-index principal pivoting [Murty 1974], finite because a small compliance on the
/// diagonal makes it a P-matrix; that compliance also keeps contradictory constraints solvable
/// (they share the violation).

#include <Eigen/Core>

namespace condyle {

struct SmallQp {
  Eigen::Matrix<double, 6, 6> H;
  Eigen::Matrix<double, 6, 1> g;
  Eigen::Matrix<double, Eigen::Dynamic, 6> C;
  Eigen::VectorXd b;
  Eigen::Matrix<double, Eigen::Dynamic, 6> A;
  Eigen::VectorXd d;
  double floor = 0;       ///< least eigenvalue of the reduced H
  double compliance = 0;  ///< relative, on the diagonal of the complementarity problem
};

struct SmallQpSolution {
  Eigen::Matrix<double, 6, 1> x;
  Eigen::VectorXd lambda;  ///< of A x >= d, >= 0
  Eigen::VectorXd nu;      ///< of C x = b
};

[[nodiscard]] SmallQpSolution solve_qp(const SmallQp& qp);

/// z >= 0 with w = M z + q >= 0 and z.w = 0, M a P-matrix.
[[nodiscard]] Eigen::VectorXd solve_complementarity(const Eigen::MatrixXd& M,
                                                    const Eigen::VectorXd& q);

}  // namespace condyle
