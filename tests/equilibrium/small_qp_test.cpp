#include "condyle/equilibrium/small_qp.h"

#include <gtest/gtest.h>

namespace condyle {
namespace {

SmallQp quadratic_about(const Eigen::Matrix<double, 6, 1>& target) {
  SmallQp qp;
  qp.H.setIdentity();
  qp.g = -target;
  qp.C.resize(0, 6);
  qp.b.resize(0);
  qp.A.resize(0, 6);
  qp.d.resize(0);
  qp.floor = 1e-6;
  qp.compliance = 1e-12;
  return qp;
}

using Vector6 = Eigen::Matrix<double, 6, 1>;

TEST(SmallQp, WithoutConstraintsIsTheMinimum) {
  const Vector6 target = (Vector6() << 1, -2, 3, 0, 0.5, 4).finished();
  EXPECT_LT((solve_qp(quadratic_about(target)).x - target).norm(), 1e-12);
}

// min ½|x - t|² with x0 + x1 = 1: the projection of t onto the plane.
TEST(SmallQp, EqualityProjects) {
  SmallQp qp = quadratic_about((Vector6() << 2, 1, 0, 0, 0, 0).finished());
  qp.C = (Eigen::Matrix<double, 1, 6>() << 1, 1, 0, 0, 0, 0).finished();
  qp.b = Eigen::VectorXd::Constant(1, 1);
  const SmallQpSolution solution = solve_qp(qp);
  EXPECT_NEAR(solution.x[0], 1, 1e-12);
  EXPECT_NEAR(solution.x[1], 0, 1e-12);
  EXPECT_NEAR(solution.nu[0], -1, 1e-12);  // H x + g = (−1, −1) = Cᵀ ν
}

// x0 >= 3 holds the minimum at 1 back with the multiplier 2; x1 >= -5 is idle.
TEST(SmallQp, OnlyTheActiveInequalityHasAMultiplier) {
  SmallQp qp = quadratic_about((Vector6() << 1, 1, 0, 0, 0, 0).finished());
  qp.A.resize(2, 6);
  qp.A << 1, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0;
  qp.d = Eigen::Vector2d(3, -5);
  const SmallQpSolution solution = solve_qp(qp);
  EXPECT_NEAR(solution.x[0], 3, 1e-9);
  EXPECT_NEAR(solution.x[1], 1, 1e-9);
  EXPECT_NEAR(solution.lambda[0], 2, 1e-9);
  EXPECT_EQ(solution.lambda[1], 0);
}

TEST(SmallQp, DuplicateConstraintsShareTheForce) {
  SmallQp qp = quadratic_about(Vector6::Zero());
  qp.A.resize(2, 6);
  qp.A << 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0;
  qp.d = Eigen::Vector2d(1, 1);
  const SmallQpSolution solution = solve_qp(qp);
  EXPECT_NEAR(solution.x[0], 1, 1e-6);
  EXPECT_NEAR(solution.lambda.sum(), 1, 1e-6);
}

TEST(SmallQp, ContradictoryConstraintsStayFinite) {
  SmallQp qp = quadratic_about(Vector6::Zero());
  qp.compliance = 1e-6;
  qp.A.resize(2, 6);
  qp.A << 1, 0, 0, 0, 0, 0, -1, 0, 0, 0, 0, 0;
  qp.d = Eigen::Vector2d(1, 1);  // x0 >= 1 and x0 <= -1
  const SmallQpSolution solution = solve_qp(qp);
  EXPECT_TRUE(solution.x.allFinite());
  EXPECT_NEAR(solution.x[0], 0, 1e-3);  // the violation is shared
}

TEST(SmallQp, NegativeCurvatureIsTurnedRound) {
  SmallQp qp = quadratic_about((Vector6() << 1, 0, 0, 0, 0, 0).finished());
  qp.H(0, 0) = -1;
  EXPECT_NEAR(solve_qp(qp).x[0], 1,
              1e-12);  // goes down the slope, by the magnitude of the curvature
}

}  // namespace
}  // namespace condyle
