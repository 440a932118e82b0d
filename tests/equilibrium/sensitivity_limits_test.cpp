/// Derivatives where they are those of one side, or none: a contact about to open, a ligament that goes
/// slack, numbers that nothing is known of, a singular matrix.

#include <gtest/gtest.h>

#include <cmath>

#include "condyle/equilibrium/sensitivity.h"
#include "support/led_paths.h"
#include "support/studied_knees.h"
#include "support/words_of.h"

namespace condyle {
namespace {

using Eigen::Vector3d;
using test::nominal;
using test::quadric;
using test::Solved;
using test::Studied;
using test::words_of;

// A knee whose lateral contact is about to open under a moment that lifts it: with the contact's force
// at zero the derivatives of either side are those with the contact and without.
TEST(Sensitivity, IsOneSidedWhereAContactOpens) {
  Studied knee = nominal(test::quadric_knee());
  Load moment;
  moment.moment = true;
  moment.vector = {0, 1000, 0};
  knee.model.loads.push_back(moment);
  knee.model.load_names.emplace_back("moment");
  knee.drive = drive_of(knee.model);
  const ModelParameter scale{ParameterKind::kLoadScale, 1};
  const PoseOutput force{OutputKind::kContactForce, 1}, adduction{OutputKind::kJointCoordinate, 1};
  for (ContactPair& pair : knee.model.pairs) pair.mode = ContactMode::kClosed;
  Solved closed(knee);
  // Newton for the scale at which the force vanishes.
  for (int i = 0; i < 8; ++i) {
    const double slope = closed.sensitivity.derivative(force, scale);
    knee.drive.scales[1] -= value_of(force, closed.pose) / slope;
    closed.pose = closed.solver.solve(knee.drive);
    ASSERT_TRUE(closed.pose.converged()) << closed.pose.reason;
    ASSERT_TRUE(closed.sensitivity.set(closed.at()));
  }
  EXPECT_LT(std::abs(value_of(force, closed.pose)), 1e-9);
  EXPECT_TRUE(one_sided_contacts(closed.at(), closed.pose).empty());  // held closed: it may pull
  Studied open = knee, free = knee;
  open.model.start = free.model.start = closed.solver.solution().X;
  open.model.pairs[1].mode = ContactMode::kOpen;
  for (ContactPair& pair : free.model.pairs) pair.mode = ContactMode::kAuto;
  Solved without(open), either(free);
  const std::vector<OneSidedContact> flagged = one_sided_contacts(either.at(), either.pose);
  ASSERT_EQ(flagged.size(), 1U);
  EXPECT_EQ(flagged[0].pair, 1U);
  const double with_it = closed.sensitivity.derivative(adduction, scale),
               without_it = without.sensitivity.derivative(adduction, scale);
  EXPECT_GT(std::abs(with_it - without_it), 0.1 * std::abs(without_it));
  const double h = 1e-4, sign = closed.sensitivity.derivative(force, scale) > 0 ? 1 : -1;
  const double here = value_of(adduction, either.pose);
  const auto slope_to = [&](double by) {
    Drive drive = knee.drive;
    drive.scales[1] += by;
    const PoseResult pose = either.solver.solve(drive);
    EXPECT_TRUE(pose.converged()) << pose.reason;
    EXPECT_EQ(pose.contacts[1].closed, by * sign > 0);
    return (value_of(adduction, pose) - here) / by;
  };
  EXPECT_NEAR(slope_to(sign * h), with_it, 1e-3 * std::abs(with_it));
  EXPECT_NEAR(slope_to(-sign * h), without_it, 1e-3 * std::abs(without_it));
}

// A ligament at its slack length: force and slope are continuous, so the derivatives are too.
TEST(Sensitivity, IsContinuousWhereALigamentGoesSlack) {
  Studied knee = quadric();
  Solved before(knee);
  auto& law = std::get<ToeLinearLaw>(knee.model.elements[0].law);
  const double length = before.pose.ligaments[0].length;
  const auto derivative_with = [&](double slack) {
    law.slack_length = slack;
    Solved solved(knee);
    return solved.sensitivity.derivative({OutputKind::kJointCoordinate, 4},
                                         {ParameterKind::kLoadScale, 0});
  };
  // From slack to a hair of strain; the length itself changes with that.
  law.slack_length = 2 * length;
  const double free = Solved(knee).pose.ligaments[0].length;
  const double taut = derivative_with(free * (1 - 1e-7)),
               slack = derivative_with(free * (1 + 1e-7));
  EXPECT_NEAR(taut, slack, 1e-4 * std::abs(slack));
}

TEST(Sensitivity, WhatIsNotKnownIsRefusedByName) {
  Studied knee = quadric(false, true);
  knee.model.elements[0].law = PolynomialLaw{{-600, 20}, true};
  knee.model.elements[4].path = std::make_shared<test::PegPath>(
      Vector3d(0.5 * (knee.model.elements[4].x_C + knee.model.elements[4].s_D)));
  knee.model.pairs[1].mode = ContactMode::kOpen;
  Solved solved(knee);
  const PoseOutput flexion{};
  const auto refused = [&](const ModelParameter& parameter) {
    return words_of([&] { (void)solved.sensitivity.derivative(flexion, parameter); });
  };
  EXPECT_EQ(refused({ParameterKind::kReferenceStrain, 0}),
            "reference strain of \"aACL\": its law has none, expected toe-linear or quadratic");
  EXPECT_EQ(refused({ParameterKind::kTransitionStrain, 7}),
            "transition strain of \"capsule\": its law has none, expected toe-linear");
  EXPECT_EQ(refused({ParameterKind::kInsertion, 4, OfBody::kMoving, 1}),
            "insertion of \"aMCL\" on the moving body, y: how its path follows that end is not "
            "known");
  EXPECT_EQ(refused({ParameterKind::kLoadVector, 0, OfBody::kFixed, 2}),
            "vector of \"compression\", z: the load computes itself");
  EXPECT_EQ(refused({ParameterKind::kLoadPoint, 2}),
            "point of \"moment\", x: a moment has no point");
  EXPECT_EQ(refused({ParameterKind::kSlackLength, 8}),
            "slack length of number 8: the model has 8 line elements");
  EXPECT_EQ(refused({ParameterKind::kInsertion, 1, OfBody::kFixed, 3}),
            "insertion of \"pACL\" on the fixed body, ?: its component is 3, expected 0, 1 or 2");
  EXPECT_EQ(refused({ParameterKind::kLayerModulus, 0, OfBody::kBoth}),
            "modulus of both layers of \"medial\": its surfaces are rigid");
  EXPECT_EQ(words_of([&] {
              (void)solved.sensitivity.derivative({OutputKind::kContactResultant, 1},
                                                  {ParameterKind::kStiffness, 1});
            }),
            "contact \"lateral\": it has no such closed point");
  EXPECT_EQ(words_of([&] {
              (void)solved.sensitivity.derivative({OutputKind::kLayerForce, 0},
                                                  {ParameterKind::kStiffness, 1});
            }),
            "contact \"medial\": it is no layer that is pressed");
  // An open contact carries nothing, and goes on so.
  EXPECT_EQ(
      solved.sensitivity.derivative({OutputKind::kContactForce, 1}, {ParameterKind::kStiffness, 1}),
      0);
}

// Prescribed twice, a motion has no multipliers of its own.
TEST(Sensitivity, SaysNothingWhereTheMatrixIsSingular) {
  Studied knee = quadric();
  Solved solved(knee);
  knee.model.conditions.push_back(knee.model.conditions[0]);
  knee.model.condition_names.emplace_back("again");
  knee.drive = drive_of(knee.model);
  EquilibriumState state = solved.solver.solution();
  state.sigma.push_back(0);
  NewtonSystem system(knee.model);
  ASSERT_TRUE(system.assemble(state, knee.drive));
  Sensitivity sensitivity(knee.model);
  EXPECT_FALSE(sensitivity.set(linearization(system, state, knee.drive)));
  EXPECT_THROW((void)sensitivity.derivative({}, {}), std::logic_error);
}

}  // namespace
}  // namespace condyle
