#include "condyle/network/multiplier_solver.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

namespace condyle {
namespace {

// Rows of very different size.
TEST(MultiplierSolver, SolvesIndependentRows) {
  Eigen::MatrixXd J(3, 4);
  J << 1, 2, 0, 1, 0, 1e4, 3e4, 2e4, 1e-3, 0, 0, 2e-3;
  const Eigen::MatrixXd C = J * J.transpose();
  const Eigen::Vector3d mu(2, -1e-4, 500);
  MultiplierSolver solver;
  solver.factor(C);
  const Eigen::VectorXd found = solver.solve(C * mu);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(found[k], mu[k], 1e-10 * std::abs(mu[k]));
}

// The same row twice: each carries half.
TEST(MultiplierSolver, DependentRowsShareTheirLoad) {
  Eigen::MatrixXd J(3, 4);
  J << 1, 2, 0, 1, 1, 2, 0, 1, 0, 0, 1, 0;
  const Eigen::MatrixXd C = J * J.transpose();
  MultiplierSolver solver;
  solver.factor(C);
  const Eigen::VectorXd found = solver.solve(C * Eigen::Vector3d(4, 0, 7));
  EXPECT_NEAR(found[0], 2, 1e-9);
  EXPECT_NEAR(found[1], 2, 1e-9);
  EXPECT_NEAR(found[2], 7, 1e-9);
}

}  // namespace
}  // namespace condyle
