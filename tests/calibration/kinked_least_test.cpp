/// Leasts of costs whose rows have kinks: closed solutions in Clarke's sense, with bounds and outliers.

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "condyle/calibration/least_squares.h"

namespace condyle::test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// y_i = B_i θ + max(0, A_i θ): smooth rows where A_i is 0. No prior, no bounds.
LeastSquaresProblem kinked_problem(const MatrixXd& B, const MatrixXd& A, const VectorXd& d) {
  LeastSquaresProblem problem;
  problem.evaluate = [B, A](const VectorXd& theta, VectorXd& y, MatrixXd* J) {
    const VectorXd beyond = A * theta;
    y = B * theta + beyond.cwiseMax(0);
    if (J == nullptr) return true;
    *J = B;
    for (Index i = 0; i < B.rows(); ++i)
      if (beyond[i] > 0) J->row(i) += A.row(i);
    return true;
  };
  problem.d = d;
  problem.sd = VectorXd::Ones(d.size());
  problem.prior_sd = VectorXd::Constant(B.cols(), std::numeric_limits<double>::infinity());
  problem.prior_mean = VectorXd::Zero(B.cols());
  problem.lower = VectorXd::Constant(B.cols(), -1e300);
  problem.upper = VectorXd::Constant(B.cols(), 1e300);
  return problem;
}

/// Rows θ0, θ1 measured as `aim`, and max(0, aᵀθ) measured -1.
struct OneKink {
  Vector2d a{1, 0.5};
  Vector2d aim{0.25, 0.5};
  /// Least of ½ |θ - aim|² + ½ (1 + max(0, aᵀθ))²: the projection on aᵀθ = 0, for aᵀaim = 0.5 is
  /// less than |a|².
  [[nodiscard]] Vector2d least() const { return aim - a.dot(aim) / a.squaredNorm() * a; }
  [[nodiscard]] LeastSquaresProblem problem() const {
    MatrixXd B = MatrixXd::Zero(3, 2), A = MatrixXd::Zero(3, 2);
    B.topRows(2).setIdentity();
    A.row(2) = a.transpose();
    return kinked_problem(B, A, Vector3d(aim[0], aim[1], -1));
  }
};

TEST(KinkedLeast, LiesOnTheKinkWhereTheGradientsOfItsSidesCancel) {
  const OneKink kink;
  for (const Vector2d& start : {Vector2d(3, -1), Vector2d(-2, 5), Vector2d(0.3, 0.2)}) {
    const LeastSquaresResult result = solve_least_squares(kink.problem(), start);
    EXPECT_TRUE(result.converged) << result.message;
    EXPECT_NE(result.message.find("kink"), std::string::npos) << result.message;
    EXPECT_LT((result.theta - kink.least()).norm(), 1e-3);  // as far as sides are told apart
    ASSERT_EQ(result.one_sided.size(), 1U);
    EXPECT_EQ(result.one_sided[0], 2);
  }
}

TEST(KinkedLeast, AKinkThatIsNotInTheWayIsNotTold) {
  OneKink kink;
  kink.aim = Vector2d(-1, -1);
  const LeastSquaresResult result = solve_least_squares(kink.problem(), Vector2d(3, 1));
  EXPECT_TRUE(result.converged) << result.message;
  EXPECT_LT((result.theta - kink.aim).norm(), 1e-8);
  EXPECT_TRUE(result.one_sided.empty());
}

TEST(KinkedLeast, OfTwoKinksThatCrossIsWhereTheyCross) {
  // ½ |θ - aim|² + ½ Σ (1 + max(0, a_kᵀθ))², a_k along two axes: aim - θ = Σ λ_k a_k, λ_k in [0, 1].
  const Vector3d a0(1, 0.2, 0), a1(0.1, 1, -0.3);
  const Vector3d least = 0.7 * a0.cross(a1), aim = least + 0.4 * a0 + 0.6 * a1;
  MatrixXd B = MatrixXd::Zero(5, 3), A = MatrixXd::Zero(5, 3);
  B.topRows(3).setIdentity();
  A.row(3) = a0.transpose();
  A.row(4) = a1.transpose();
  VectorXd d(5);
  d << aim, -1, -1;
  std::mt19937 numbers(3);
  std::normal_distribution<double> normal;
  for (int k = 0; k < 20; ++k) {
    const Vector3d start = Vector3d::NullaryExpr([&] { return 2 * normal(numbers); });
    const LeastSquaresResult result = solve_least_squares(kinked_problem(B, A, d), start);
    EXPECT_TRUE(result.converged) << result.message;
    EXPECT_LT((result.theta - least).norm(), 2e-3) << start.transpose();
    EXPECT_EQ(result.one_sided, (std::vector<Index>{3, 4}));
  }
}

TEST(KinkedLeast, AtABoundLiesWhereBothMeet) {
  OneKink kink;
  LeastSquaresProblem problem = kink.problem();
  problem.upper[0] = kink.least()[0] - 0.05;
  const LeastSquaresResult result = solve_least_squares(problem, Vector2d(-2, 0));
  // On θ0 = u the cost is least at aim_1 where that lies before the kink, else on the kink.
  const double u = problem.upper[0];
  const double on_kink = -u * kink.a[0] / kink.a[1];
  const double expected = std::min(kink.aim[1], on_kink);
  EXPECT_TRUE(result.converged) << result.message;
  EXPECT_LE(result.theta[0], u);
  EXPECT_NEAR(result.theta[0], u, 1e-3);
  EXPECT_NEAR(result.theta[1], expected, 1e-3);
}

TEST(KinkedLeast, OutliersPullNoFurtherThanTheirBound) {
  // As OneKink, its third row told 100 off: Huber's δ = 1 pulls by 1, as the residual of 1 does.
  const OneKink kink;
  LeastSquaresProblem problem = kink.problem();
  problem.d[2] = -100;
  problem.huber = 1;
  const LeastSquaresResult result = solve_least_squares(problem, Vector2d(3, -1));
  EXPECT_TRUE(result.converged) << result.message;
  EXPECT_LT((result.theta - kink.least()).norm(), 2e-3);
}

TEST(KinkedLeast, CurvedRowsAndACurvedKinkLeadThere) {
  // Rows θ0 - 1, θ1 and 1 + 2 max(0, θ0² + θ1 - 1/4): the least lies on the parabola, where
  // (θ0 - 1, θ1) = -λ (2 θ0, 1).
  LeastSquaresProblem problem = OneKink().problem();
  problem.d = Vector3d(1, 0, -1);
  problem.evaluate = [](const VectorXd& t, VectorXd& y, MatrixXd* J) {
    const double beyond = t[0] * t[0] + t[1] - 0.25;
    y = Vector3d(t[0], t[1], 2 * std::max(0.0, beyond));
    if (J == nullptr) return true;
    *J = MatrixXd::Identity(3, 2);
    if (beyond > 0) J->row(2) = Eigen::RowVector2d(4 * t[0], 2);
    return true;
  };
  double x = 0.5;  // least of (x - 1)² + (1/4 - x²)², by Newton
  for (int k = 0; k < 50; ++k) x -= (2 * (x - 1) - 4 * x * (0.25 - x * x)) / (2 - 1 + 12 * x * x);
  for (const Vector2d& start : {Vector2d(3, -1), Vector2d(-1, 2), Vector2d(0.5, 0)}) {
    const LeastSquaresResult result = solve_least_squares(problem, start);
    EXPECT_TRUE(result.converged) << result.message;
    EXPECT_LT((result.theta - Vector2d(x, 0.25 - x * x)).norm(), 2e-3);
    EXPECT_EQ(result.one_sided, std::vector<Index>{2});
  }
}

}  // namespace
}  // namespace condyle::test
