/// The least of a sum of squares: closed solutions, bounds, outliers, and where there are no
/// predictions.

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include <cmath>
#include <limits>

#include "condyle/calibration/least_squares.h"
#include "support/random_matrix.h"

namespace condyle::test {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// y = A θ, sd and prior of 1, no bounds, measured value d.
LeastSquaresProblem linear_problem(const MatrixXd& A, const VectorXd& d) {
  LeastSquaresProblem problem;
  problem.evaluate = [A](const VectorXd& theta, VectorXd& y, MatrixXd* J) {
    y = A * theta;
    if (J != nullptr) *J = A;
    return true;
  };
  const Eigen::Index n = A.cols();
  problem.d = d;
  problem.sd = VectorXd::Ones(A.rows());
  problem.prior_sd = VectorXd::Ones(n);
  problem.prior_mean = VectorXd::Zero(n);
  problem.lower = VectorXd::Constant(n, -1e300);
  problem.upper = VectorXd::Constant(n, 1e300);
  return problem;
}

/// Rosenbrock's valley: rows 10 (y - x²) and 1 - x, least 0 at (1, 1).
LeastSquaresProblem rosenbrock() {
  LeastSquaresProblem problem = linear_problem(MatrixXd::Identity(2, 2), Vector2d::Zero());
  problem.prior_sd.setConstant(kInfinity);
  problem.evaluate = [](const VectorXd& t, VectorXd& y, MatrixXd* J) {
    y = Vector2d(10 * (t[1] - t[0] * t[0]), 1 - t[0]);
    if (J != nullptr) *J = (MatrixXd(2, 2) << -20 * t[0], 10, -1, 0).finished();
    return true;
  };
  return problem;
}

TEST(LeastSquares, OfALinearProblemIsThatOfTheNormalEquations) {
  const MatrixXd A = random_matrix(40, 5, 1);
  LeastSquaresProblem problem = linear_problem(A, random_matrix(40, 1, 2));
  problem.sd = VectorXd::LinSpaced(40, 0.1, 3);
  problem.prior_sd = VectorXd::LinSpaced(5, 0.01, 100);
  problem.prior_mean = VectorXd::LinSpaced(5, -0.02, 50);
  const VectorXd w = problem.sd.cwiseAbs2().cwiseInverse();
  const VectorXd p = problem.prior_sd.cwiseAbs2().cwiseInverse();
  const MatrixXd precision = A.transpose() * w.asDiagonal() * A + MatrixXd(p.asDiagonal());
  const VectorXd expected = precision.ldlt().solve(A.transpose() * w.cwiseProduct(problem.d) +
                                                   p.cwiseProduct(problem.prior_mean));

  const LeastSquaresResult result = solve_least_squares(problem, VectorXd::Zero(5));

  EXPECT_TRUE(result.converged) << result.message;
  // A trust region of 1e4 leaves 1e-4 of the error a step; the least is flat to 1e-8 in double.
  EXPECT_LT((result.theta - expected).cwiseQuotient(problem.prior_sd).norm(), 1e-7);
  EXPECT_TRUE(result.y.isApprox(A * result.theta, 1e-14));
  EXPECT_EQ(result.J, A);
  const double chi_square = (result.y - problem.d).cwiseQuotient(problem.sd).squaredNorm();
  EXPECT_DOUBLE_EQ(result.chi_square, chi_square);
  EXPECT_DOUBLE_EQ(
      result.cost,
      0.5 * (chi_square +
             (result.theta - problem.prior_mean).cwiseQuotient(problem.prior_sd).squaredNorm()));
}

TEST(LeastSquares, ExactDataWithoutPriorGiveTheTruthToTwelveFigures) {
  const LeastSquaresResult result = solve_least_squares(rosenbrock(), Vector2d(-1.2, 1));
  EXPECT_TRUE(result.converged) << result.message;
  EXPECT_LT((result.theta - Vector2d(1, 1)).norm(), 1e-12);
  EXPECT_EQ(result.refused, 0);
}

TEST(LeastSquares, DoesNotDependOnTheUnitsOfTheParameters) {
  LeastSquaresProblem problem = rosenbrock();
  const LeastSquaresResult expected = solve_least_squares(problem, Vector2d(-1.2, 1));
  // x in units of 2^20, y of 2^-30: exact in double, so every bit is the same.
  const Vector2d unit(std::exp2(20), std::exp2(-30));
  problem.evaluate = [inner = problem.evaluate, unit](const VectorXd& t, VectorXd& y, MatrixXd* J) {
    const bool there = inner(t.cwiseProduct(unit), y, J);
    if (J != nullptr) *J = *J * unit.asDiagonal();
    return there;
  };
  const LeastSquaresResult result =
      solve_least_squares(problem, Vector2d(-1.2, 1).cwiseQuotient(unit));
  EXPECT_EQ(VectorXd(result.theta.cwiseProduct(unit)), expected.theta);
  EXPECT_EQ(result.iterations, expected.iterations);
}

TEST(LeastSquares, StepsThatLeaveThePredictionsAreShortenedAndCounted) {
  LeastSquaresProblem problem = rosenbrock();
  // Gauss-Newton's first step from here leaps to (1, -3.84): no predictions below y = x² - 2.
  problem.evaluate = [inner = problem.evaluate](const VectorXd& t, VectorXd& y, MatrixXd* J) {
    return t[1] > t[0] * t[0] - 2 && inner(t, y, J);
  };
  const LeastSquaresResult result = solve_least_squares(problem, Vector2d(-1.2, 1));
  EXPECT_TRUE(result.converged) << result.message;
  EXPECT_GT(result.refused, 0);
  EXPECT_LT((result.theta - Vector2d(1, 1)).norm(), 1e-12);
}

TEST(LeastSquares, ALeastBehindAWallIsNotCalledConverged) {
  LeastSquaresProblem problem = linear_problem(MatrixXd::Identity(1, 1), VectorXd::Constant(1, 3));
  problem.prior_sd.setConstant(kInfinity);
  problem.evaluate = [](const VectorXd& t, VectorXd& y, MatrixXd* J) {
    y = t;
    if (J != nullptr) *J = MatrixXd::Identity(1, 1);
    return t[0] < 2;
  };
  const LeastSquaresResult result = solve_least_squares(problem, VectorXd::Zero(1));
  EXPECT_FALSE(result.converged);
  EXPECT_FALSE(result.stopped);
  EXPECT_GT(result.refused, 0);
  EXPECT_LT(result.theta[0], 2);
  EXPECT_GT(result.theta[0], 1);  // steps are cut by half and less: a good part of the way is made
}

TEST(LeastSquares, ALeastAtAKinkIsOne) {
  // ½ (|θ0| + 1)² + ½ (θ1 - 1)²: least at (0, 1), where the gradient of θ0 is 1 or -1.
  LeastSquaresProblem problem = linear_problem(MatrixXd::Identity(2, 2), Vector2d(-1, 1));
  problem.prior_sd.setConstant(kInfinity);
  problem.evaluate = [](const VectorXd& t, VectorXd& y, MatrixXd* J) {
    y = Vector2d(std::abs(t[0]), t[1]);
    if (J != nullptr) *J = Vector2d(t[0] < 0 ? -1 : 1, 1).asDiagonal();
    return true;
  };
  const LeastSquaresResult result = solve_least_squares(problem, Vector2d(0.7, -2));
  EXPECT_TRUE(result.converged);
  EXPECT_NE(result.message.find("kink"), std::string::npos) << result.message;
  EXPECT_NEAR(result.theta[0], 0, 1e-3);
  EXPECT_NEAR(result.theta[1], 1, 1e-3);
}

TEST(LeastSquares, NoPredictionsAtTheStartAreToldAndNothingIsThrown) {
  LeastSquaresProblem problem = rosenbrock();
  problem.evaluate = [](const VectorXd&, VectorXd&, MatrixXd*) { return false; };
  const LeastSquaresResult result = solve_least_squares(problem, Vector2d(-1.2, 1));
  EXPECT_FALSE(result.converged);
  EXPECT_FALSE(result.message.empty());
  EXPECT_EQ(result.theta, VectorXd(Vector2d(-1.2, 1)));
}

TEST(LeastSquares, PredictionsThatAreNoNumbersAreNone) {
  LeastSquaresProblem problem = rosenbrock();
  problem.evaluate = [inner = problem.evaluate](const VectorXd& t, VectorXd& y, MatrixXd* J) {
    inner(t, y, J);
    if (t[1] < t[0] * t[0] - 2) y[0] = std::nan("");
    return true;
  };
  ::testing::internal::CaptureStderr();
  const LeastSquaresResult result = solve_least_squares(problem, Vector2d(-1.2, 1));
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  EXPECT_TRUE(result.converged) << result.message;
  EXPECT_GT(result.refused, 0);
}

TEST(LeastSquares, HoldsBoundsAndFindsTheLeastBesideThem) {
  // ½ (θ0 + θ1 - 3)² + ½ (θ0 - θ1)² with θ0 <= 1: least at θ1 = 3/2, gradient of θ0 is -1.
  const MatrixXd A = (MatrixXd(2, 2) << 1, 1, 1, -1).finished();
  LeastSquaresProblem problem = linear_problem(A, Vector2d(3, 0));
  problem.prior_sd.setConstant(kInfinity);
  problem.upper[0] = 1;
  const LeastSquaresResult result = solve_least_squares(problem, Vector2d(0, 0));
  EXPECT_TRUE(result.converged) << result.message;
  EXPECT_EQ(result.theta[0], 1);
  EXPECT_NEAR(result.theta[1], 1.5, 1e-6);
}

TEST(LeastSquares, HuberDrawsAnOutlierNoFurtherThanItsBound) {
  // Of one number measured nine times 0 and once 100, δ = 2: least of 9/2 x² + 2 (100 - x) - 2 is x = 2/9.
  // A cost told to 1e-12 tells x to the root of that, times 10.
  LeastSquaresProblem problem = linear_problem(MatrixXd::Ones(10, 1), VectorXd::Zero(10));
  problem.d[4] = 100;
  problem.prior_sd.setConstant(kInfinity);
  EXPECT_NEAR(solve_least_squares(problem, VectorXd::Zero(1)).theta[0], 10, 1e-6);
  problem.huber = 2;
  const LeastSquaresResult result = solve_least_squares(problem, VectorXd::Zero(1));
  EXPECT_TRUE(result.converged) << result.message;
  EXPECT_NEAR(result.theta[0], 2. / 9, 1e-7);
  EXPECT_NEAR(result.cost, 0.5 * 9 * 4. / 81 + 2 * (100 - 2. / 9) - 2, 1e-9);
  EXPECT_NEAR(result.chi_square, 9 * 4. / 81 + std::pow(100 - 2. / 9, 2), 1e-4);
}

TEST(LeastSquares, DirectionsThatNoDatumSeesStayWhereTheyWere) {
  // Six parameters, three directions seen; no prior.
  const MatrixXd A = random_matrix(20, 3, 5) * random_matrix(3, 6, 6);
  const VectorXd truth = random_matrix(6, 1, 7);
  LeastSquaresProblem problem = linear_problem(A, A * truth);
  problem.prior_sd.setConstant(kInfinity);
  const LeastSquaresResult result = solve_least_squares(problem, VectorXd::Zero(6));
  EXPECT_TRUE(result.converged) << result.message;
  EXPECT_LT((A * (result.theta - truth)).norm(), 1e-10 * (A * truth).norm());
  EXPECT_LT(result.theta.norm(), 10 * truth.norm());
}

TEST(LeastSquares, StopsWhenToldToWithTheBestSoFar) {
  LeastSquaresOptions options;
  std::vector<double> costs;
  options.on_step = [&](int iteration, double cost, const VectorXd&) {
    costs.push_back(cost);
    EXPECT_EQ(iteration, static_cast<int>(costs.size()));
    return iteration < 3;
  };
  const LeastSquaresResult result = solve_least_squares(rosenbrock(), Vector2d(-1.2, 1), options);
  EXPECT_TRUE(result.stopped);
  EXPECT_FALSE(result.converged);
  ASSERT_EQ(costs.size(), 3U);
  EXPECT_GT(costs[0], costs[1]);
  EXPECT_GT(costs[1], costs[2]);
  EXPECT_EQ(result.cost, costs[2]);
  EXPECT_EQ(result.iterations, 3);
}

TEST(LeastSquares, AsksForEachThetaOnce) {
  LeastSquaresProblem problem = rosenbrock();
  problem.upper.setConstant(5);  // bounds bring a line search
  std::vector<VectorXd> asked;
  problem.evaluate = [&asked, inner = problem.evaluate](const VectorXd& t, VectorXd& y,
                                                        MatrixXd* J) {
    for (const VectorXd& other : asked) EXPECT_NE(other, t);
    asked.push_back(t);
    return inner(t, y, J);
  };
  const LeastSquaresResult result = solve_least_squares(problem, Vector2d(-1.2, 1));
  EXPECT_TRUE(result.converged) << result.message;
}

}  // namespace
}  // namespace condyle::test
