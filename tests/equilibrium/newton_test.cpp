#include "condyle/equilibrium/newton.h"

#include <gtest/gtest.h>

#include <cmath>

#include "condyle/equilibrium/equilibrium_solver.h"
#include "condyle/math/rotation.h"
#include "support/hold.h"
#include "support/report_problems.h"
#include "support/spring_knee.h"

namespace condyle {
namespace {

/// The Cardan angle w of R = Ry(w).
double angle_about_y(const RigidTransform& X) { return std::atan2(X.R(0, 2), X.R(2, 2)); }

// Exact answers (docs/dortmans.md), e.g. w = -1.4056476493802696, p = 32.11453374, sigma =
// 119.90259274 at phi = 0.
TEST(Newton, ReportProblem1HasTheExactAnswerInFiveIterationsPerIncrement) {
  using P = test::Problem1;
  Model model = P::model(0);
  Newton newton(model);
  EquilibriumState state;
  state.X = {exp_rotation({0, -1.3, 0}), {1, 0, 0}};
  state.contacts = {{0, {Place{{2, 0, 0}}, Place{{1, 0, 0}}}, 0}};
  state.contacts[0].places.on_A = {state.X.R.transpose() * Eigen::Vector3d(1, 0, 0)};
  state.sigma = {0};
  for (const double phi : {0.0, 0.5, 1.0, 1.5, 2.0, 2.5}) {
    const NewtonReport report = newton.solve(state, condition_value(0).with(drive_of(model), phi));
    ASSERT_EQ(report.outcome, NewtonOutcome::kConverged) << "phi = " << phi;
    EXPECT_LE(report.iterations, 5);  // the report: 4, and one for the tolerance of 1e-12
    EXPECT_NEAR(angle_about_y(state.X), P::w(phi), 1e-12);
    EXPECT_NEAR(state.X.p.x(), 1, 1e-12);
    EXPECT_NEAR(state.contacts[0].p, P::p(phi), 1e-12 * 120);
    EXPECT_NEAR(state.sigma[0], P::sigma(phi), 1e-12 * 120);
    EXPECT_NEAR(state.contacts[0].places.on_B.numbers.z(), phi, 1e-12);
  }
  EXPECT_NEAR(test::Problem1::p(0), 32.11453374, 1e-8);
  EXPECT_NEAR(test::Problem1::sigma(0), 119.90259274, 1e-8);
}

// w = 0, sigma_x = -1 - 6 alpha, sigma_z = -4.
TEST(Newton, ReportProblem2HasTheExactAnswerInThreeIterations) {
  Model model = test::six_elements(1);
  model.conditions = {test::held(ConditionKind::kTranslation, Eigen::Vector3d::UnitX(), 0, 0),
                      test::held(ConditionKind::kTranslation, Eigen::Vector3d::UnitZ(), 0, 3)};
  model.condition_names = {"x", "z"};
  Newton newton(model);
  EquilibriumState state;
  state.X = model.start;
  state.sigma = {0, 0};
  for (const double alpha : {0.0, 0.1, 0.2, 0.3}) {
    const NewtonReport report =
        newton.solve(state, condition_value(0).with(drive_of(model), alpha));
    ASSERT_EQ(report.outcome, NewtonOutcome::kConverged);
    EXPECT_LE(report.iterations, 3);
    EXPECT_NEAR(state.sigma[0], -1 - 6 * alpha, 1e-12 * 10);
    EXPECT_NEAR(state.sigma[1], -4, 1e-12 * 10);
    EXPECT_NEAR((state.X.R - Eigen::Matrix3d::Identity()).norm(), 0, 1e-12);
  }
}

// Centre (0, 0, 7/3), sigma = -10 sin w.
TEST(Newton, ReportProblem3HasTheExactAnswerInFourIterations) {
  Model model = test::six_elements(0);
  model.conditions = {test::held(ConditionKind::kRotation, Eigen::Vector3d::UnitX(), 1, 0)};
  model.condition_names = {"w"};
  Newton newton(model);
  EquilibriumState state;
  state.X = model.start;
  state.sigma = {0};
  for (const double w : {0.0, 0.1, 0.2, 0.3, 0.4}) {
    const NewtonReport report = newton.solve(state, condition_value(0).with(drive_of(model), w));
    ASSERT_EQ(report.outcome, NewtonOutcome::kConverged);
    EXPECT_LE(report.iterations, 4);
    EXPECT_NEAR(state.sigma[0], -10 * std::sin(w), 1e-12 * 30);
    EXPECT_NEAR((state.X.p - Eigen::Vector3d(0, 0, 7.0 / 3)).norm(), 0, 1e-12 * 10);
  }
}

TEST(Newton, ResidualFallsQuadratically) {
  Model model = test::Problem1::model(0);
  EquilibriumState state;
  state.X = {exp_rotation({0, -1.2, 0}), {1, 0, 0}};
  state.contacts = {
      {0, {Place{{2, 0, 0}}, Place{state.X.R.transpose() * Eigen::Vector3d(1, 0, 0)}}, 0}};
  state.sigma = {0};
  std::vector<double> error;
  for (int k = 0; k < 5; ++k) {
    Newton newton(model, {.max_iterations = 1});
    newton.solve(state, drive_of(model));
    error.push_back(std::abs(angle_about_y(state.X) - test::Problem1::w(0)));
  }
  // e_{k+1} <= C e_k² with C of order one; 1e-12 is the tolerance at which Newton stops.
  ASSERT_LT(error.back(), 1e-12);
  for (std::size_t k = 1; k + 1 < error.size(); ++k)
    EXPECT_LE(error[k + 1], 3 * error[k] * error[k] + 1e-12);
}

// One Newton step from a displaced pose must land within the square of the displacement in every
// direction, which a wrong entry of the matrix would not allow: half the displacement, a quarter of
// the error.
TEST(Newton, OneStepLeavesTheSquareOfTheDisplacement) {
  Model model = test::spring_knee();
  model.conditions[0].value = 0.5;
  EquilibriumSolver solver(model);
  ASSERT_TRUE(solver.solve().converged());
  const EquilibriumState solution = solver.state();
  const auto error_after = [&](int direction, double size) {
    EquilibriumState state = solution;
    if (direction < 3) {
      state.X.p += size * model.length * Eigen::Vector3d::Unit(direction);
    } else {
      state.X.R = exp_rotation(size * Eigen::Vector3d::Unit(direction - 3)) * state.X.R;
    }
    Newton newton(model, {.max_iterations = 1});
    newton.solve(state, drive_of(model));
    return (state.X.p - solution.X.p).norm() + model.length * (state.X.R - solution.X.R).norm();
  };
  for (int direction = 0; direction < 6; ++direction) {
    const double whole = error_after(direction, 1e-4), half = error_after(direction, 0.5e-4);
    EXPECT_GT(whole / half, 3.5) << direction;
  }
}

TEST(Newton, ContactThatDependsOnAConditionIsSingular) {
  Model model = test::Problem1::model(0);
  // The contact already prescribes the x-position of the centre.
  model.conditions.push_back(
      test::held(ConditionKind::kTranslation, Eigen::Vector3d::UnitX(), 0, 1));
  model.condition_names.emplace_back("x");
  Newton newton(model);
  EquilibriumState state;
  state.X = {exp_rotation({0, -1.3, 0}), {1, 0, 0}};
  state.contacts = {
      {0, {Place{{2, 0, 0}}, Place{state.X.R.transpose() * Eigen::Vector3d(1, 0, 0)}}, 0}};
  state.sigma = {0, 0};
  EXPECT_EQ(newton.solve(state, drive_of(model)).outcome, NewtonOutcome::kSingular);
}

TEST(Newton, ElementWithoutLengthIsNamed) {
  Model model = test::six_elements(0);
  model.elements[2].x_C = model.start * model.elements[2].s_D;
  Newton newton(model);
  EquilibriumState state;
  state.X = model.start;
  const NewtonReport report = newton.solve(state, drive_of(model));
  EXPECT_EQ(report.outcome, NewtonOutcome::kZeroLength);
  EXPECT_EQ(report.zero_element, 2);
}

}  // namespace
}  // namespace condyle
