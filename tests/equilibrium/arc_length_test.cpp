#include "condyle/equilibrium/arc_length.h"
#include "condyle/math/degree.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/quadric_knee.h"
#include "support/report_problems.h"
#include "support/truss.h"

namespace condyle {
namespace {

using test::Truss;

constexpr Swept kPress = load_scale(0);

TEST(ArcLength, FollowsTheTrussThroughBothLimitPoints) {
  EquilibriumSolver solver(Truss::model());
  const double end = 2 * Truss::limit_load();
  const SweepResult path = follow_path(solver, kPress, 0, end, 0.5);
  ASSERT_GT(path.poses.size(), 20u);
  double lowest = 0, last_z = Truss::h + 1e-12;
  for (const PoseResult& pose : path.poses) {
    ASSERT_TRUE(pose.converged()) << pose.value << ": " << pose.reason;
    const double z = pose.X_BA.p.z();
    EXPECT_NEAR(pose.value, Truss::load(z), 1e-10);
    EXPECT_LE(z, last_z);  // down all the way
    EXPECT_EQ(pose.stability, std::abs(z) > Truss::limit_height() ? 1 : 0) << z;
    lowest = std::min(lowest, pose.value);
    last_z = z;
  }
  EXPECT_EQ(path.poses.front().value, 0);
  EXPECT_EQ(path.poses.back().value, end);
  EXPECT_LT(path.poses.back().X_BA.p.z(), -Truss::h);
  EXPECT_LT(lowest, -0.9 * Truss::limit_load());
  ASSERT_EQ(path.events.size(), 2u);
  for (const Event& event : path.events) {
    EXPECT_EQ(event.kind, EventKind::kLimitPoint);
    EXPECT_EQ(event.contact, -1);
  }
  EXPECT_NEAR(path.events[0].value, Truss::limit_load(), 1e-9);
  EXPECT_NEAR(path.events[1].value, -Truss::limit_load(), 1e-9);
}

TEST(ArcLength, EndsBeforeTheLimitPointWhereItIsAskedTo) {
  EquilibriumSolver solver(Truss::model());
  const SweepResult path = follow_path(solver, kPress, 0, 0.9 * Truss::limit_load(), 1);
  EXPECT_TRUE(path.events.empty());
  EXPECT_EQ(path.poses.back().value, 0.9 * Truss::limit_load());
  EXPECT_GT(path.poses.back().X_BA.p.z(), Truss::limit_height());
  for (std::size_t k = 1; k < path.poses.size(); ++k)
    EXPECT_LT(path.poses[k].value - path.poses[k - 1].value, 1 + 1e-9);
}

// Snapping through, the apex lands on a floor: at the load that belongs to z = -7.
TEST(ArcLength, ClosesAContactAfterTheSnapAndOpensItAgain) {
  EquilibriumSolver solver(Truss::with_floor());
  const SweepResult down = follow_path(solver, kPress, 0, 40, 1);
  ASSERT_EQ(down.events.size(), 3u);
  EXPECT_EQ(down.events[2].kind, EventKind::kClosing);
  EXPECT_NEAR(down.events[2].value, Truss::load(-7), 1e-9);
  const PoseResult& pressed = down.poses.back();
  ASSERT_TRUE(pressed.converged()) << pressed.reason;
  EXPECT_NEAR(pressed.X_BA.p.z(), -7, 1e-10);
  EXPECT_NEAR(pressed.contacts[0].force, 40 - Truss::load(-7), 1e-9);

  const SweepResult up = follow_path(solver, kPress, 40, 10, 1);
  ASSERT_EQ(up.events.size(), 1u);
  EXPECT_EQ(up.events[0].kind, EventKind::kOpening);
  EXPECT_NEAR(up.events[0].value, Truss::load(-7), 1e-9);
  EXPECT_NEAR(Truss::load(up.poses.back().X_BA.p.z()), 10, 1e-10);
}

// Without limit points the path is that of a sweep in steps.
TEST(ArcLength, FollowsAKneeWhereASweepDoes) {
  EquilibriumSolver follower(test::quadric_knee());
  const SweepResult path = follow_path(follower, condition_value(0), 0, 90 * kDegree, 5 * kDegree);
  EXPECT_TRUE(path.events.empty());
  ASSERT_GE(path.poses.size(), 19u);
  EXPECT_EQ(path.poses.back().value, 90 * kDegree);
  EquilibriumSolver stepper(test::quadric_knee());
  for (const PoseResult& pose : path.poses) {
    ASSERT_TRUE(pose.converged()) << pose.reason;
    const PoseResult expected =
        stepper.solve(condition_value(0).with(drive_of(stepper.model()), pose.value));
    ASSERT_TRUE(expected.converged());
    EXPECT_LT((pose.X_BA.p - expected.X_BA.p).norm(), 1e-9);
    EXPECT_LT((pose.X_BA.R - expected.X_BA.R).norm(), 1e-10);
    EXPECT_NEAR(pose.contacts[0].force, expected.contacts[0].force, 1e-8);
  }
}

// Problem 1 of the report: the wall is left at a pull of p(0) [docs/dortmans.md].
TEST(ArcLength, OpensAContactWhereItsForceVanishes) {
  Model model = test::Problem1::model(0, 1);
  model.start.R = exp_rotation({0, -1.3, 0});
  EquilibriumSolver solver(std::move(model));
  const SweepResult path = follow_path(solver, load_scale(1), 0, 40, 4);
  ASSERT_EQ(path.events.size(), 1u);
  EXPECT_EQ(path.events[0].kind, EventKind::kOpening);
  EXPECT_NEAR(path.events[0].value, test::Problem1::p(0), 1e-9);
  EXPECT_FALSE(path.poses.back().contacts[0].closed);
  EXPECT_EQ(path.poses.back().value, 40);
}

// A pull that stretches a string of finite strength: the path ends nowhere, and says so.
TEST(ArcLength, SaysWhyItStopped) {
  Model model = Truss::model();
  for (LineElement& spring : model.elements) spring.law = PolynomialLaw{{1.0}, false};
  // A constant tension of 1 N carries less than 2 N however far the apex is pulled down.
  EquilibriumSolver solver(std::move(model));
  const SweepResult path = follow_path(solver, kPress, 0, 3, 0.1, {.most_poses = 200});
  EXPECT_FALSE(path.poses.back().converged());
  EXPECT_FALSE(path.poses.back().reason.empty());
}

}  // namespace
}  // namespace condyle
