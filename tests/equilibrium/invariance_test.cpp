/// One knee told in several ways has one answer.

#include <gtest/gtest.h>

#include <vector>

#include "condyle/equilibrium/equilibrium_solver.h"
#include "condyle/math/degree.h"
#include "support/quadric_knee.h"

namespace condyle {
namespace {

std::vector<PoseResult> path(const test::QuadricKneeView& view) {
  EquilibriumSolver solver(test::quadric_knee(view));
  std::vector<PoseResult> poses;
  for (int flexion = 0; flexion <= 90; flexion += 15) {
    poses.push_back(
        solver.solve(condition_value(0).with(drive_of(solver.model()), flexion * kDegree)));
    EXPECT_TRUE(poses.back().converged()) << flexion << ": " << poses.back().reason;
  }
  return poses;
}

/// Joint coordinates, forces and multipliers do not depend on who looks.
void expect_same_answer(const std::vector<PoseResult>& expected,
                        const std::vector<PoseResult>& actual,
                        double unit = 1,
                        bool same_origin = true) {
  ASSERT_EQ(expected.size(), actual.size());
  for (std::size_t k = 0; k < expected.size(); ++k) {
    const PoseResult &e = expected[k], &a = actual[k];
    EXPECT_NEAR(e.joint.adduction, a.joint.adduction, 1e-10);
    EXPECT_NEAR(e.joint.internal_rotation, a.joint.internal_rotation, 1e-10);
    EXPECT_NEAR(e.joint.lateral_shift, a.joint.lateral_shift / unit, 1e-8);
    EXPECT_NEAR(e.joint.anterior_drawer, a.joint.anterior_drawer / unit, 1e-8);
    EXPECT_NEAR(e.joint.distraction, a.joint.distraction / unit, 1e-8);
    ASSERT_EQ(e.contacts.size(), a.contacts.size());
    for (std::size_t c = 0; c < e.contacts.size(); ++c) {
      EXPECT_EQ(e.contacts[c].points.size(), a.contacts[c].points.size());
      EXPECT_NEAR(e.contacts[c].force, a.contacts[c].force, 1e-7);
    }
    for (std::size_t i = 0; i < e.ligaments.size(); ++i)
      EXPECT_NEAR(e.ligaments[i].force, a.ligaments[i].force, 1e-7);
    EXPECT_NEAR(e.conditions[0].multiplier, a.conditions[0].multiplier / unit, 1e-6);
    if (same_origin) {  // an eigenvalue depends on the point about which rotations count
      EXPECT_NEAR(e.lowest_stiffness, a.lowest_stiffness * unit, 1e-7 * e.lowest_stiffness);
    }
  }
}

class Invariance : public testing::Test {
 protected:
  static void SetUpTestSuite() { reference() = path({}); }
  static std::vector<PoseResult>& reference() {
    static std::vector<PoseResult> poses;
    return poses;
  }
};

TEST_F(Invariance, BothContactsCarryFrom0To90Degrees) {
  for (const PoseResult& pose : reference()) {
    for (const ContactResult& contact : pose.contacts) EXPECT_GT(contact.force, 10);
    EXPECT_EQ(pose.stability, 1);
  }
}

TEST_F(Invariance, TurningTheSceneTurnsTheAnswer) {
  const test::QuadricKneeView view{.X = {exp_rotation({0.4, -1.1, 0.7}), {12, -40, 7}}};
  const std::vector<PoseResult> turned = path(view);
  expect_same_answer(reference(), turned);
  for (std::size_t k = 0; k < turned.size(); ++k) {
    const RigidTransform expected = view.X * reference()[k].X_BA;
    EXPECT_LT((turned[k].X_BA.p - expected.p).norm(), 1e-8);
    EXPECT_LT((turned[k].X_BA.R - expected.R).norm(), 1e-9);
    const Eigen::Vector3d point = view.X * reference()[k].contacts[0].points[0].point_ground;
    EXPECT_LT((turned[k].contacts[0].points[0].point_ground - point).norm(), 1e-8);
  }
}

TEST_F(Invariance, ALeftKneeMovesAsItsMirrorImage) {
  const std::vector<PoseResult> left = path({.left = true});
  expect_same_answer(reference(), left);
  const Eigen::Vector3d mirror(-1, 1, 1);
  for (std::size_t k = 0; k < left.size(); ++k) {
    const Eigen::Vector3d p = mirror.cwiseProduct(reference()[k].X_BA.p);
    EXPECT_LT((left[k].X_BA.p - p).norm(), 1e-8);
    const Eigen::Matrix3d R = mirror.asDiagonal() * reference()[k].X_BA.R * mirror.asDiagonal();
    EXPECT_LT((left[k].X_BA.R - R).norm(), 1e-9);
  }
}

// The compression acts on the tibia where it moves, and on the femur as a reaction where that does.
TEST_F(Invariance, ItDoesNotMatterWhichBodyIsFixed) {
  const std::vector<PoseResult> swapped = path({.femur_moves = true});
  expect_same_answer(reference(), swapped, 1, false);
  for (std::size_t k = 0; k < swapped.size(); ++k) {
    const RigidTransform inverse = reference()[k].X_BA.inverse();
    EXPECT_LT((swapped[k].X_BA.p - inverse.p).norm(), 1e-8);
    EXPECT_LT((swapped[k].X_BA.R - inverse.R).norm(), 1e-9);
    const ContactPointResult &e = reference()[k].contacts[0].points[0],
                             &a = swapped[k].contacts[0].points[0];
    EXPECT_LT((a.point_ground - e.point_moving).norm(), 1e-8);
    EXPECT_LT((a.point_moving - e.point_ground).norm(), 1e-8);
  }
}

TEST_F(Invariance, AllAtOnce) {
  const test::QuadricKneeView view{
      .X = {exp_rotation({-2.1, 0.3, 0.9}), {-300, 40, 110}}, .left = true, .femur_moves = true};
  expect_same_answer(reference(), path(view), 1, false);
}

// The same knee in cm and m: lengths, moments and stiffnesses change with the unit, forces do not.
TEST_F(Invariance, TheUnitOfLengthDoesNotMatter) {
  expect_same_answer(reference(), path({.unit = 0.1}), 0.1);
  expect_same_answer(reference(), path({.unit = 0.001}), 0.001);
}

}  // namespace
}  // namespace condyle
