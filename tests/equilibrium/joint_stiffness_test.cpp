#include "condyle/equilibrium/joint_stiffness.h"

#include <gtest/gtest.h>

#include "condyle/equilibrium/equilibrium_solver.h"
#include "support/quadric_knee.h"

namespace condyle {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

constexpr std::array<ConditionKind, 6> kKinds = {
    ConditionKind::kFlexion,      ConditionKind::kAdduction,      ConditionKind::kInternalRotation,
    ConditionKind::kLateralShift, ConditionKind::kAnteriorDrawer, ConditionKind::kDistraction};

EquilibriumOptions with_stiffness() {
  EquilibriumOptions options;
  options.description.joint_stiffness = true;
  return options;
}

KinematicCondition coordinate(const JointFrames& frames, std::size_t i) {
  KinematicCondition condition;
  condition.kind = kKinds[i];
  condition.frames = frames;
  return condition;
}

/// The load that does the work Q.dq: the transposed Jacobian times Q, with its derivatives.
Load conjugate_load(const JointFrames& frames, const Vector6& Q) {
  Load load;
  load.custom = [frames, Q](const RigidTransform& X, Wrench& wrench) {
    for (std::size_t i = 0; i < 6; ++i) {
      const ConditionDerivatives k = evaluate(coordinate(frames, i), 0, X);
      const double q = Q[static_cast<Eigen::Index>(i)];
      wrench.f += q * k.alpha;
      wrench.m += q * k.eta;
      wrench.F1 += q * k.D1;
      wrench.F2 += q * k.D2;
      wrench.M1 += q * k.D3;
      wrench.M2 += q * k.D4;
    }
  };
  return load;
}

Vector6 in_order(const JointCoordinates& q) {
  Vector6 v;
  v << q.flexion, q.adduction, q.internal_rotation, q.lateral_shift, q.anterior_drawer,
      q.distraction;
  return v;
}

/// Largest difference of two matrices with angles counted as L times the angle.
double difference(const Matrix6& a, const Matrix6& b, double angle) {
  const Vector6 scale = (Vector6() << angle, angle, angle, 1, 1, 1).finished();
  const Matrix6 d = scale.asDiagonal() * (a - b) * scale.asDiagonal();
  const Matrix6 of = scale.asDiagonal() * b * scale.asDiagonal();
  return d.cwiseAbs().maxCoeff() / of.cwiseAbs().maxCoeff();
}

PoseResult solve(EquilibriumSolver& solver, const Drive& drive) {
  PoseResult pose = solver.solve(drive);
  EXPECT_TRUE(pose.converged()) << pose.reason;
  return pose;
}

// The knee of two ellipsoids with flexion held: the compliance is what a small added load does to
// the solved pose, the contacts rolling and sliding along. Also for a left knee whose femur moves.
TEST(JointStiffness, ComplianceIsWhatSmallLoadsDo) {
  for (const bool other : {false, true}) {
    test::QuadricKneeView view;
    view.left = view.femur_moves = other;
    Model model = test::quadric_knee(view);
    model.conditions[0].value = 0.5;
    const std::size_t first = model.loads.size();
    for (Eigen::Index i = 0; i < 6; ++i) {
      model.loads.push_back(conjugate_load(*model.joint, Vector6::Unit(i)));
      model.loads.back().scale = 0;
      model.load_names.push_back("added " + std::to_string(i));
    }
    EquilibriumSolver solver(model, with_stiffness());
    const Drive drive = drive_of(model);
    const PoseResult pose = solve(solver, drive);
    ASSERT_TRUE(pose.joint_stiffness);
    Matrix6 C;
    for (Eigen::Index i = 0; i < 6; ++i) {
      const double step = i < 3 ? 1 : 0.02;  // N mm, N
      const Swept scale = load_scale(first + static_cast<std::size_t>(i));
      C.col(i) = in_order(solve(solver, scale.with(drive, step)).joint);
      C.col(i) -= in_order(solve(solver, scale.with(drive, -step)).joint);
      C.col(i) /= 2 * step;
    }
    EXPECT_LT(difference(pose.joint_stiffness->compliance, C, 1. / 30), 1e-6) << C;
    // Flexion is prescribed: no load moves it.
    EXPECT_LT(pose.joint_stiffness->compliance.row(0).cwiseAbs().maxCoeff(),
              1e-12 * C.cwiseAbs().maxCoeff());
  }
}

/// Only ligaments and a moment that holds them: nothing touches.
Model hanging_knee() {
  Model model = test::quadric_knee();
  model.pairs.clear();
  model.conditions.clear();
  model.condition_names.clear();
  model.loads[0].follows_body = false;
  model.loads[0].vector = {3, -5, -150};  // pulls the tibia down
  return model;
}

// Without contacts and conditions the stiffness is what it takes to prescribe all six coordinates:
// the multipliers by differences. And compliance is its inverse.
TEST(JointStiffness, StiffnessIsWhatPrescribedCoordinatesAskFor) {
  const Model free = hanging_knee();
  EquilibriumSolver solver(free, with_stiffness());
  const PoseResult pose = solve(solver, drive_of(solver.model()));
  ASSERT_TRUE(pose.joint_stiffness);
  Model held = free;
  const Vector6 at = in_order(pose.joint);
  for (std::size_t i = 0; i < 6; ++i) {
    held.conditions.push_back(coordinate(*free.joint, i));
    held.conditions.back().value = at[static_cast<Eigen::Index>(i)];
    held.condition_names.push_back("coordinate " + std::to_string(i));
  }
  Matrix6 S;
  for (std::size_t i = 0; i < 6; ++i) {
    const double step = i < 3 ? 1e-4 : 3e-3;
    Vector6 Q[2];
    for (const int side : {0, 1}) {
      Model moved = held;
      moved.conditions[i].value += side == 0 ? -step : step;
      moved.start = pose.X_BA;
      EquilibriumSolver moved_solver(moved);
      const PoseResult there = solve(moved_solver, drive_of(moved_solver.model()));
      for (Eigen::Index k = 0; k < 6; ++k)
        Q[side][k] = -there.conditions[static_cast<std::size_t>(k)].multiplier;
    }
    S.col(static_cast<Eigen::Index>(i)) = (Q[1] - Q[0]) / (2 * step);
  }
  EXPECT_LT(difference(pose.joint_stiffness->stiffness, S, 30), 1e-5) << S;
  EXPECT_LT(difference(pose.joint_stiffness->compliance * S, Matrix6::Identity(), 1), 1e-4);
}

// Forces with an energy, and contacts: symmetric, also in joint coordinates.
TEST(JointStiffness, IsSymmetricWhereForcesHaveAnEnergy) {
  Model model = test::quadric_knee();
  model.loads[0].follows_body = false;
  EquilibriumSolver solver(model, with_stiffness());
  const PoseResult pose = solve(solver, drive_of(solver.model()));
  ASSERT_TRUE(pose.joint_stiffness);
  const JointStiffness& joint = *pose.joint_stiffness;
  EXPECT_LT(difference(joint.stiffness, joint.stiffness.transpose(), 30), 1e-10);
  EXPECT_LT(difference(joint.compliance, joint.compliance.transpose(), 1. / 30), 1e-10);
}

// Six conditions leave no motion: nothing yields. No joint, or a pose that nothing holds: nothing
// said.
TEST(JointStiffness, SaysNothingWhereThereIsNone) {
  Model model = test::quadric_knee();
  model.pairs.clear();
  model.conditions.clear();
  model.condition_names.clear();
  for (std::size_t i = 0; i < 6; ++i) {
    model.conditions.push_back(coordinate(*model.joint, i));
    model.condition_names.emplace_back("held");
  }
  EquilibriumSolver mechanism(model, with_stiffness());
  const PoseResult held = solve(mechanism, drive_of(mechanism.model()));
  ASSERT_TRUE(held.joint_stiffness);
  EXPECT_EQ(held.joint_stiffness->compliance, Matrix6::Zero());

  Model loose = model;
  loose.elements.clear();
  loose.conditions.clear();
  loose.loads.clear();
  NewtonSystem nothing(loose);
  const EquilibriumState free;
  (void)nothing.assemble(free, {});
  EXPECT_FALSE(joint_stiffness(linearization(nothing, free, {})));
  loose.joint.reset();
  EXPECT_FALSE(joint_stiffness(linearization(nothing, free, {})));
  // Adduction of 90 degrees: flexion and internal rotation are the same turn.
  const RigidTransform across{rotation_from_joint_angles(*model.joint, 0, M_PI / 2, 0), {0, 0, 0}};
  NewtonSystem there(model);
  const EquilibriumState at_90{across, {}, std::vector<double>(6, 0.0)};
  (void)there.assemble(at_90, drive_of(model));
  EXPECT_FALSE(joint_stiffness(linearization(there, at_90, drive_of(model))));
}

}  // namespace
}  // namespace condyle
