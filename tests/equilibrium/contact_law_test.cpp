/// A contact law without unknowns is one thing that can be exchanged: a spring between two balls
/// (support/two_balls.h), which the scene format does not know, against its closed form.

#include "condyle/contact/contact_law.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "condyle/equilibrium/arc_length.h"
#include "condyle/equilibrium/equilibrium_solver.h"
#include "condyle/equilibrium/joint_stiffness.h"
#include "condyle/equilibrium/linearization.h"
#include "condyle/equilibrium/stability.h"
#include "condyle/equilibrium/sweep.h"
#include "support/allocation_count.h"
#include "support/hold.h"
#include "support/instruction_count.h"
#include "support/numerical_jacobian.h"
#include "support/patch_knee.h"
#include "support/quadric_knee.h"
#include "support/random.h"
#include "support/two_balls.h"

namespace condyle {
namespace {

using Eigen::Vector3d;
using test::TwoBalls;

Load pushing(const Vector3d& force) {
  Load load;
  load.vector = force;
  return load;
}

/// A ball of radius 10 over a ball of radius 20 about the origin, k = 50 N/mm, turning held:
/// pressed down by `force`, held sideways or not.
Model ball_over_ball(double force, bool guided, test::LawCount* count = nullptr) {
  Model model;
  const TwoBalls balls{{0, 0, 0}, {0, 0, 0}, 20, 10, 50};
  model.pairs = {test::pair_of_balls(balls, count)};
  for (int axis = 0; axis < 3; ++axis) test::hold(model, ConditionKind::kRotation, axis);
  if (guided)
    for (int axis = 0; axis < 2; ++axis) test::hold(model, ConditionKind::kTranslation, axis);
  model.loads = {pushing({0, 0, -force})};
  model.load_names = {"weight"};
  model.start = {Eigen::Matrix3d::Identity(), {0, 0, 31}};
  model.length = 20;
  return model;
}

TEST(ContactLaw, OfTheTestHasExactDerivatives) {
  test::Random random(5);
  test::BallSpring spring({{1, 2, 3}, {4, -2, 5}, 30, 25, 40}, nullptr);
  for (int k = 0; k < 10; ++k) {
    const RigidTransform X = random.pose(15);
    const auto wrench_at = [&](const RigidTransform& at) {
      Wrench wrench;
      spring.add_to(at, wrench);
      return wrench;
    };
    const Wrench w = wrench_at(X);
    ASSERT_GT(w.f.norm(), 1);
    const auto f = [&](const RigidTransform& at) { return wrench_at(at).f; };
    const auto m = [&](const RigidTransform& at) { return wrench_at(at).m; };
    EXPECT_LT((w.F1 - test::jacobian_of_translation(f, X)).norm(), 1e-8 * w.F1.norm());
    EXPECT_LT((w.F2 - test::jacobian_of_rotation(f, X)).norm(), 1e-8 * w.F2.norm());
    EXPECT_LT((w.M1 - test::jacobian_of_translation(m, X)).norm(), 1e-8 * w.M1.norm());
    EXPECT_LT((w.M2 - test::jacobian_of_rotation(m, X)).norm(), 1e-8 * w.M2.norm());
    const auto energy = [&](const Vector3d& da) {
      return Eigen::Matrix<double, 1, 1>(spring.energy(test::displaced(X, da, Vector3d::Zero())));
    };
    EXPECT_LT((w.f.transpose() + test::jacobian_at_zero<1, 3>(energy)).norm(), 1e-8 * w.f.norm());
  }
}

// 100 N on 50 N/mm: 2 mm deep, whether Newton starts pressed or the descent from above.
TEST(ContactLaw, CarriesALoadAtItsClosedForm) {
  for (const double start : {29.0, 31.0, 60.0}) {
    Model model = ball_over_ball(100, true);
    model.start.p.z() = start;
    EquilibriumSolver solver(model);
    const PoseResult pose = solver.solve();
    ASSERT_TRUE(pose.converged()) << start << ": " << pose.reason;
    EXPECT_NEAR(pose.X_BA.p.z(), 28, 1e-10);
    ASSERT_TRUE(pose.contacts[0].closed);
    EXPECT_NEAR(pose.contacts[0].force, 100, 1e-9);
    EXPECT_NEAR(pose.contacts[0].points[0].gap, -2, 1e-10);
    EXPECT_LT((pose.contacts[0].resultant_ground - Vector3d(0, 0, 20)).norm(), 1e-9);
    EXPECT_NEAR(pose.lowest_stiffness, 50, 1e-9);
    EXPECT_EQ(pose.stability, 1);
  }
}

// Free to roll off sideways the ball on top is unstable: -p/r, r = 28 mm between the centres.
TEST(ContactLaw, StabilitySeesItsStiffness) {
  const Model model = ball_over_ball(100, false);
  NewtonSystem system(model);
  const Drive drive = drive_of(model);
  const EquilibriumState state{{Eigen::Matrix3d::Identity(), {0, 0, 28}}, {}, {0, 0, 0}};
  ASSERT_TRUE(system.assemble(state, drive));
  EXPECT_LT(system.out_of_balance(), 1e-12);
  const Stability found = stability(linearization(system, state, drive));
  EXPECT_NEAR(found.lowest_stiffness, -100. / 28, 1e-12);
  EXPECT_FALSE(found.stable());
}

/// The quadric knee with a soft ball of the tibia against the femur's from behind.
Model knee_with_law(double stiffness, test::LawCount* count = nullptr, bool coarse = false) {
  Model model = test::quadric_knee();
  const Vector3d at = EquilibriumSolver(model).solve().X_BA.p;
  const Vector3d center_B(0, -60, 0), center_A = Vector3d(0, -31, 0) - at;
  TwoBalls balls{center_B, center_A, 20, 15, stiffness};
  balls.coarse_first = coarse;
  if (stiffness > 0) model.pairs.push_back(test::pair_of_balls(balls, count));
  return model;
}

TEST(ContactLaw, MixesWithRigidContactsInOneScene) {
  const Model rigid = test::quadric_knee();
  EquilibriumOptions options;
  options.description.joint_stiffness = true;
  EquilibriumSolver solver(knee_with_law(8), options), without(rigid, options);
  const PoseResult pose = solver.solve(), other = without.solve();
  ASSERT_TRUE(pose.converged()) << pose.reason;
  ASSERT_TRUE(pose.contacts[2].closed);
  EXPECT_GT(pose.contacts[0].force, 0);
  EXPECT_GT(pose.contacts[1].force, 0);
  EXPECT_NEAR(pose.contacts[2].force, -8 * pose.contacts[2].points[0].gap, 1e-9);
  EXPECT_GT((pose.X_BA.p - other.X_BA.p).norm(), 0.05);
  // The same equilibrium with that force as a dead load at the same point of the tibia.
  Model loaded = rigid;
  const ContactPointResult& point = pose.contacts[2].points[0];
  loaded.loads.push_back(pushing(point.force * point.normal_ground));
  loaded.loads.back().at = point.point_moving;
  loaded.load_names.emplace_back("spring");
  loaded.start = pose.X_BA;
  const PoseResult same = EquilibriumSolver(loaded).solve();
  ASSERT_TRUE(same.converged());
  EXPECT_LT((same.X_BA.p - pose.X_BA.p).norm(), 1e-9);
  EXPECT_LT((same.X_BA.R - pose.X_BA.R).norm(), 1e-11);
  for (const std::size_t c : {0, 1})
    EXPECT_NEAR(same.contacts[c].force, pose.contacts[c].force, 1e-8);
}

// The compliance says what a small added load does: solved again with it.
TEST(ContactLaw, JointComplianceIsThatOfPosesSolvedAgain) {
  EquilibriumOptions options;
  options.description.joint_stiffness = true;
  Model model = knee_with_law(8);
  model.loads.push_back(pushing({0, 1, 0}));
  model.load_names.emplace_back("added");
  model.loads.back().scale = 0;
  EquilibriumSolver solver(model, options);
  const PoseResult pose = solver.solve();
  ASSERT_TRUE(pose.converged() && pose.joint_stiffness);
  ASSERT_TRUE(pose.contacts[2].closed);
  const auto load = load_scale(model.loads.size() - 1);
  const auto drawer = [&](double newtons) {
    const PoseResult there = solver.solve(load.with(drive_of(model), newtons));
    EXPECT_TRUE(there.converged()) << there.reason;
    Eigen::Matrix<double, 6, 1> q;
    q << there.joint.flexion, there.joint.adduction, there.joint.internal_rotation,
        there.joint.lateral_shift, there.joint.anterior_drawer, there.joint.distraction;
    return q;
  };
  const double step = 0.02;  // N
  const Eigen::Matrix<double, 6, 1> slope = (drawer(step) - drawer(-step)) / (2 * step);
  // Q of a dead force F at O_A: Jᵀ Q = (F, 0).
  Eigen::Matrix<double, 6, 1> wrench = Eigen::Matrix<double, 6, 1>::Zero();
  wrench[1] = 1;
  const Eigen::Matrix<double, 6, 6> J = joint_jacobian(*model.joint, pose.X_BA);
  const Eigen::Matrix<double, 6, 1> Q = J.transpose().fullPivLu().solve(wrench);
  const Eigen::Matrix<double, 6, 1> foretold = pose.joint_stiffness->compliance * Q;
  EXPECT_LT((slope - foretold).norm(), 1e-5 * foretold.norm());
}

TEST(ContactLaw, WhatItHoldsIsRefinedAndThePoseSolvedOn) {
  test::LawCount count;
  EquilibriumSolver solver(knee_with_law(8, &count, true)), fine(knee_with_law(8));
  const PoseResult pose = solver.solve(), expected = fine.solve();
  ASSERT_TRUE(pose.converged()) << pose.reason;
  EXPECT_EQ(count.refined, 1);
  EXPECT_GT(count.prepared, 0);
  EXPECT_LT((pose.X_BA.p - expected.X_BA.p).norm(), 1e-10);
  EXPECT_NEAR(pose.contacts[2].force, expected.contacts[2].force, 1e-9);
  // Of a reset solver the first pose is the same to the last bit.
  solver.reset();
  const PoseResult again = solver.solve();
  EXPECT_EQ(count.refined, 2);
  EXPECT_EQ(again.X_BA.p, pose.X_BA.p);
  EXPECT_EQ(again.X_BA.R, pose.X_BA.R);
}

TEST(ContactLaw, ASweepAndAPathGoThroughTouchAndLiftOff) {
  const Model model = knee_with_law(8);
  EquilibriumSolver solver(model);
  std::vector<double> values;
  for (int k = 0; k <= 18; ++k) values.push_back(k * 5 * std::numbers::pi / 180);
  const SweepResult swept = sweep(solver, condition_value(0), values);
  EXPECT_EQ(swept.count_converged(), 19);
  int closed = 0;
  for (const PoseResult& pose : swept.poses) closed += pose.contacts[2].closed ? 1 : 0;
  EXPECT_GT(closed, 1);
  EXPECT_LT(closed, 19);
  solver.reset();
  const SweepResult path = follow_path(solver, condition_value(0), 0, values[6], values[1]);
  ASSERT_FALSE(path.poses.empty());
  EXPECT_TRUE(path.poses.back().converged()) << path.poses.back().reason;
  EXPECT_NEAR(path.poses.back().value, values[6], 1e-12);
  EXPECT_LT((path.poses.back().X_BA.p - swept.poses[6].X_BA.p).norm(), 1e-8);
}

TEST(ContactLaw, WarmPosesAllocateNothing) {
  if (!test::allocations_are_counted()) GTEST_SKIP() << "allocations are not counted here";
  EquilibriumSolver solver(knee_with_law(8));
  PoseResult pose;
  Drive drive = drive_of(solver.model());
  for (const double flexion : {0.0, 0.05, 0.1, 0.05, 0.0}) {
    drive.values[0] = flexion;
    solver.solve(drive, pose);
  }
  const test::AllocationCount count;
  for (const double flexion : {0.05, 0.1, 0.05}) {
    drive.values[0] = flexion;
    solver.solve(drive, pose);
    EXPECT_TRUE(pose.converged());
  }
  EXPECT_EQ(count.since_start(), 0);
}

TEST(ContactLaw, MayRefuseAPose) {
  Model model = ball_over_ball(100, true);
  TwoBalls shallow{{0, 0, 0}, {0, 0, 0}, 20, 10, 50, 1.5};
  model.pairs = {test::pair_of_balls(shallow)};
  const PoseResult pose = EquilibriumSolver(model).solve();
  EXPECT_EQ(pose.status, PoseStatus::kOverlap);
  EXPECT_EQ(pose.reason, "the balls are too deep in each other");
}

TEST(ContactLaw, BesideRigidPointsIsAnErrorInWords) {
  Model model = ball_over_ball(100, true);
  model.pairs[0].mode = ContactMode::kAuto;
  try {
    EquilibriumSolver solver(model);
    FAIL() << "nothing was thrown";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "contact \"balls\" has a law of its own and rigid points too, expected the mode "
                 "that leaves these out");
  }
}

// A pair that is left out costs the search for its nearest place; one with a law never asks for
// that. A knee whose pairs are all rigid has no potential at all.
TEST(ContactLaw, ARigidKneeHasNone) {
  const Model model = benchmarks::patch_knee();
  const NewtonSystem system(model);
  EXPECT_TRUE(system.potentials().empty());
  EXPECT_EQ(system.potentials().of(0), nullptr);
}

}  // namespace
}  // namespace condyle
