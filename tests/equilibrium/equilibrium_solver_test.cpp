#include "condyle/equilibrium/equilibrium_solver.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "condyle/math/degree.h"
#include "condyle/math/rotation.h"
#include "condyle/surface/exact_surfaces.h"
#include "support/ball_on_floor.h"
#include "support/hold.h"
#include "support/quadric_knee.h"
#include "support/report_problems.h"
#include "support/spring_knee.h"

namespace condyle {
namespace {

// Cancellation test [Dortmans 1986, 4.6]: a pull in -x beyond p(0) = 32.1 N opens the contact;
// without it the contact is back, with the same answer.
TEST(EquilibriumSolver, ContactOpensUnderAPullAndClosesAgain) {
  Model model = test::Problem1::model(0, 40);
  model.loads[1].scale = 0;
  model.start.R = exp_rotation({0, -1.3, 0});
  EquilibriumSolver solver(std::move(model));
  const PoseResult closed = solver.solve();
  ASSERT_TRUE(closed.converged()) << closed.reason;
  EXPECT_NEAR(closed.contacts[0].force, test::Problem1::p(0), 1e-10);

  const PoseResult open = solver.solve(load_scale(1).with(drive_of(solver.model()), 1));
  ASSERT_TRUE(open.converged()) << open.reason;
  EXPECT_FALSE(open.contacts[0].closed);
  EXPECT_LT(open.X_BA.p.x(), 1 - 1e-3);

  const PoseResult again = solver.solve();
  ASSERT_TRUE(again.converged()) << again.reason;
  EXPECT_TRUE(again.contacts[0].closed);
  EXPECT_NEAR(again.contacts[0].force, test::Problem1::p(0), 1e-10);
}

struct SpringKneePose {
  double flexion, adduction, internal_rotation;  // [deg]
  double x, y, z;                                // femoral origin in the tibial frame [mm]
};
// An independent equilibrium path of the twelve-spring model (minimum of spring energy under two
// unilateral gaps), made from parameters recalled from the literature, not published results; good
// to 0.02 mm and 0.05 degrees.
constexpr SpringKneePose kSpringKnee[] = {{0, -0.8355, -0.0375, 0.6282, 6.4148, 214.7503},
                                          {15, -0.2263, -1.3411, -1.1488, 8.4888, 219.5492},
                                          {30, 0.7111, -0.3562, -2.6283, 9.4562, 224.8070},
                                          {45, 1.2273, 4.1676, -2.4324, 9.3240, 230.1872},
                                          {60, 0.9974, 9.0884, -1.3753, 7.7760, 235.3811},
                                          {75, 0.1931, 12.7215, -0.2799, 5.0770, 240.0078},
                                          {90, -0.6032, 17.3462, 0.5966, 0.8054, 243.8068}};

TEST(EquilibriumSolver, FollowsTheIndependentPathOfTheTwelveSpringKnee) {
  EquilibriumSolver solver(test::spring_knee());
  for (const SpringKneePose& expected : kSpringKnee) {
    const PoseResult pose =
        solver.solve(condition_value(0).with(drive_of(solver.model()), expected.flexion * kDegree));
    ASSERT_TRUE(pose.converged()) << expected.flexion << ": " << pose.reason;
    EXPECT_NEAR(pose.joint.adduction / kDegree, expected.adduction, 0.05);
    EXPECT_NEAR(pose.joint.internal_rotation / kDegree, expected.internal_rotation, 0.05);
    const Eigen::Vector3d femur_in_tibia = pose.X_BA.inverse().p;
    EXPECT_LT((femur_in_tibia - Eigen::Vector3d(expected.x, expected.y, expected.z)).norm(), 0.02);
    EXPECT_LT(pose.residual, 1e-9 * 1000);
    EXPECT_EQ(pose.stability, 1);
  }
}

TEST(EquilibriumSolver, FindsTheKneeFromAGapAndFromAnOverlap) {
  EquilibriumSolver reference(test::spring_knee());
  const PoseResult expected = reference.solve();
  ASSERT_TRUE(expected.converged());
  for (const double lift : {-15.0, -5.0, 2.0, 5.0}) {
    Model model = test::spring_knee();
    model.start.p.z() += lift;  // the tibia upwards is into the femur
    EquilibriumSolver solver(std::move(model));
    const PoseResult pose = solver.solve();
    ASSERT_TRUE(pose.converged()) << "lift " << lift << ": " << pose.reason;
    EXPECT_LT((pose.X_BA.p - expected.X_BA.p).norm(), 1e-9) << "lift " << lift;
  }
}

// Turning the whole scene by any rigid motion turns the answer.
TEST(EquilibriumSolver, TurningTheWholeSceneTurnsTheAnswer) {
  EquilibriumSolver solver(test::spring_knee());
  const PoseResult pose =
      solver.solve(condition_value(0).with(drive_of(solver.model()), 30 * kDegree));
  ASSERT_TRUE(pose.converged());
  const RigidTransform X{exp_rotation({0.4, -1.1, 0.7}), {12, -40, 7}};
  EquilibriumSolver turned(test::spring_knee(X));
  const PoseResult turned_pose =
      turned.solve(condition_value(0).with(drive_of(turned.model()), 30 * kDegree));
  ASSERT_TRUE(turned_pose.converged()) << turned_pose.reason;
  const RigidTransform expected = X * pose.X_BA;
  EXPECT_LT((turned_pose.X_BA.p - expected.p).norm(), 1e-9);
  EXPECT_LT((turned_pose.X_BA.R - expected.R).norm(), 1e-10);
  EXPECT_NEAR(turned_pose.contacts[0].force, pose.contacts[0].force, 1e-8);
  EXPECT_NEAR(turned_pose.conditions[0].multiplier, pose.conditions[0].multiplier, 1e-7);
}

// Forces on the tibia from ligaments, contacts and the flexion moment add up to nothing, computed
// here from what the pose reports and not from the solver's own sums.
TEST(EquilibriumSolver, ReportedForcesBalance) {
  EquilibriumSolver solver(test::spring_knee());
  const PoseResult pose =
      solver.solve(condition_value(0).with(drive_of(solver.model()), 60 * kDegree));
  ASSERT_TRUE(pose.converged());
  Eigen::Vector3d f = Eigen::Vector3d::Zero(), m = f;
  const auto add = [&](const Eigen::Vector3d& force, const Eigen::Vector3d& point) {
    f += force;
    m += (point - pose.X_BA.p).cross(force);
  };
  for (std::size_t i = 0; i < solver.model().elements.size(); ++i) {
    const LineElement& element = solver.model().elements[i];
    const Eigen::Vector3d end = pose.X_BA * element.s_D;
    add(-pose.ligaments[i].force * (end - element.x_C).normalized(), end);
  }
  for (const ContactResult& contact : pose.contacts)
    for (const ContactPointResult& point : contact.points)
      add(point.force * point.normal_ground, point.point_ground);
  EXPECT_LT(f.norm(), 1e-9);
  // What is left of the moment is the flexion moment: about the axis along which flexion turns.
  const ConditionDerivatives flexion = evaluate(solver.model().conditions[0], 0, pose.X_BA);
  EXPECT_LT((m - pose.conditions[0].multiplier * flexion.eta).norm(), 1e-7);
}

TEST(EquilibriumSolver, LoadThatNothingCarriesIsNamed) {
  Model model;
  Load load;
  load.vector = {0, 0, -10};
  model.loads = {load};
  model.load_names = {"weight"};
  model.length = 30;
  EquilibriumSolver solver(std::move(model));
  const PoseResult pose = solver.solve();
  EXPECT_EQ(pose.status, PoseStatus::kNoEquilibrium) << pose.reason;
}

/// A ball of radius 10 on A over a floor, pushed or pulled by a load.
Model ball_over_floor(double load) {
  Model model = test::ball_on_floor("push", load);
  model.start.p = {0, 0, 9.5};
  model.length = characteristic_length(model);
  return model;
}

TEST(EquilibriumSolver, ABallPulledOffItsFloorRunsAway) {
  EquilibriumSolver solver(ball_over_floor(10));
  const PoseResult pose = solver.solve();
  EXPECT_EQ(pose.status, PoseStatus::kNoEquilibrium) << pose.reason;
}

// A ball held deep inside the solid of a floor by its conditions: whatever is found there is no
// equilibrium.
TEST(EquilibriumSolver, ABuriedBodyIsNeverConverged) {
  for (const double depth : {3.0, 30.0, 300.0}) {
    Model model = ball_over_floor(-10);
    for (int k = 0; k < 3; ++k)
      test::hold(model, ConditionKind::kTranslation, k, k == 2 ? -depth : 0);
    model.start.p = {0, 0, -depth};
    EquilibriumSolver solver(std::move(model));
    EXPECT_FALSE(solver.solve().converged()) << depth;
  }
}

TEST(EquilibriumSolver, SevenConditionsAreTooMany) {
  Model model = ball_over_floor(-10);
  for (int k = 0; k < 7; ++k)
    test::hold(model, k % 2 == 0 ? ConditionKind::kTranslation : ConditionKind::kRotation, k % 3);
  EquilibriumSolver solver(std::move(model));
  const PoseResult pose = solver.solve();
  EXPECT_EQ(pose.status, PoseStatus::kSingular);
  EXPECT_NE(pose.reason.find("six"), std::string::npos);
}

// The same pose with other contacts is another state.
TEST(EquilibriumSolver, TakesOverAStateOfTheSamePoseWithOtherContacts) {
  EquilibriumSolver solver(test::quadric_knee());
  ASSERT_TRUE(solver.solve().converged());
  EquilibriumState other = solver.state();
  ASSERT_FALSE(other.contacts.empty());
  other.contacts.pop_back();
  solver.set_state(other, drive_of(solver.model()));
  EXPECT_EQ(solver.state().contacts.size(), other.contacts.size());
}

}  // namespace
}  // namespace condyle
