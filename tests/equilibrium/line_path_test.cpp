/// A line element's path is one thing that can be exchanged: through a peg or over an edge on the ground
/// (support/led_paths.h), which the scene format does not know, in statics, stability and joint
/// stiffness.

#include "condyle/elements/line_path.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <memory>
#include <vector>

#include "condyle/equilibrium/arc_length.h"
#include "condyle/equilibrium/equilibrium_solver.h"
#include "condyle/equilibrium/linearization.h"
#include "condyle/equilibrium/stability.h"
#include "condyle/equilibrium/sweep.h"
#include "condyle/math/degree.h"
#include "support/allocation_count.h"
#include "support/hold.h"
#include "support/led_paths.h"
#include "support/quadric_knee.h"

namespace condyle {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// A weight on a string of 10 N/mm and 60 mm that comes from (-30, 0, 40), 50 mm from the origin, by
/// a path through there. Turning held.
Model weight_on_a_string(double weight, std::shared_ptr<const LinePath> path) {
  Model model;
  LineElement string{Vector3d(-30, 0, 40), Vector3d::Zero(), CustomLaw{[](double L) {
                       return Tension{10 * (L - 60), 10, 5 * (L - 60) * (L - 60)};
                     }}};
  string.path = path;
  model.elements = {string};
  model.element_names = {"string"};
  for (int axis = 0; axis < 3; ++axis) test::hold(model, ConditionKind::kRotation, axis);
  Load load;
  load.vector = {0, 0, -weight};
  model.loads = {load};
  model.load_names = {"weight"};
  model.start = {Matrix3d::Identity(), {1, 2, -25}};
  model.length = 20;
  return model;
}

// 100 N stretch it by 10 mm to 70: it hangs 20 mm below the origin, a pendulum of 100 N/20 mm. Along
// an edge the string slides: there it is one of 70 mm.
TEST(LinePath, AWeightHangsFromItLikeAPendulum) {
  const auto peg = std::make_shared<test::PegPath>(Vector3d::Zero());
  const auto edge =
      std::make_shared<test::EdgePath>(Vector3d::Zero(), Vector3d::UnitY(), Vector3d::UnitX());
  for (const bool slides : {false, true}) {
    std::shared_ptr<const LinePath> path = peg;
    if (slides) path = edge;
    EquilibriumSolver solver(weight_on_a_string(100, path));
    const PoseResult pose = solver.solve();
    ASSERT_TRUE(pose.converged()) << pose.reason;
    EXPECT_LT((pose.X_BA.p - Vector3d(0, 0, -20)).norm(), 1e-10);
    EXPECT_NEAR(pose.ligaments[0].length, 70, 1e-10);
    EXPECT_NEAR(pose.ligaments[0].force, 100, 1e-9);
    ASSERT_EQ(pose.paths[0].points.size(), 1U);
    EXPECT_LT(pose.paths[0].points[0].norm(), 1e-10);
    EXPECT_NEAR(pose.lowest_stiffness, slides ? 100. / 70 : 100. / 20, 1e-9);
    EXPECT_EQ(pose.stability, 1);
  }
}

/// The quadric knee with both strands of its MCL led through pegs 3 mm medially of their middles in
/// extension, or past edges 1 mm laterally of these: from there the strands come to lie on them with
/// flexion, as their insertions on the tibia rise.
Model knee_led(bool by_edges) {
  Model model = test::quadric_knee();
  for (const std::size_t strand : {4, 5}) {
    LineElement& element = model.elements[strand];
    const Vector3d at = 0.5 * (element.x_C + element.s_D) + Vector3d(by_edges ? 1 : -3, 0, 0);
    if (by_edges)
      element.path = std::make_shared<test::EdgePath>(at, Vector3d::UnitY(), -Vector3d::UnitX());
    else
      element.path = std::make_shared<test::PegPath>(at);
  }
  return model;
}

/// The same knee without paths: the element ends at the peg, its law shifted by the piece before.
Model knee_from_peg(const Model& knee) {
  Model model = knee;
  for (LineElement& element : model.elements) {
    if (!element.path) continue;
    std::vector<Vector3d> corners;
    element.path->add_points({}, {}, nullptr, {}, corners);
    const double before = (corners[0] - element.x_C).norm();
    element.law =
        CustomLaw{[law = element.law, before](double L) { return tension(law, L + before); }};
    element.x_C = corners[0];
    element.path = nullptr;
  }
  return model;
}

TEST(LinePath, AKneeLedByPegsIsTheKneeWhoseLigamentsBeginThere) {
  EquilibriumOptions options;
  options.description.joint_stiffness = true;
  const Model model = knee_led(false);
  EquilibriumSolver solver(model, options), other(knee_from_peg(model), options);
  Drive drive = drive_of(model);
  for (const double flexion : {0.0, 5.0, 10.0, 15.0, 40.0, 20.0}) {
    drive.values[0] = flexion * kDegree;
    const PoseResult pose = solver.solve(drive), expected = other.solve(drive);
    ASSERT_TRUE(pose.converged() && expected.converged()) << flexion << pose.reason;
    EXPECT_EQ(pose.iterations, expected.iterations);
    EXPECT_LT((pose.X_BA.p - expected.X_BA.p).norm(), 1e-10);
    EXPECT_LT((pose.X_BA.R - expected.X_BA.R).norm(), 1e-12);
    for (std::size_t i = 0; i < pose.ligaments.size(); ++i)
      EXPECT_NEAR(pose.ligaments[i].force, expected.ligaments[i].force, 1e-8);
    EXPECT_NEAR(pose.lowest_stiffness, expected.lowest_stiffness,
                1e-9 * std::abs(expected.lowest_stiffness));
    ASSERT_TRUE(pose.joint_stiffness && expected.joint_stiffness);
    EXPECT_LT((pose.joint_stiffness->stiffness - expected.joint_stiffness->stiffness).norm(),
              1e-9 * expected.joint_stiffness->stiffness.norm());
    EXPECT_LT((pose.joint_stiffness->compliance - expected.joint_stiffness->compliance).norm(),
              1e-8 * expected.joint_stiffness->compliance.norm());
  }
}

// Whether a strand lies on its edge is held while a pose is solved, and asked again then: up and
// down it is the same.
TEST(LinePath, LiesOnItsEdgeOrNotAndIsTheSameUpAndDown) {
  const Model model = knee_led(true);
  EquilibriumSolver solver(model);
  std::vector<double> up, down;
  for (int k = 0; k <= 9; ++k) up.push_back(5 * k * kDegree);
  down.assign(up.rbegin(), up.rend());
  const SweepResult rising = sweep(solver, condition_value(0), up);
  const SweepResult falling = sweep(solver, condition_value(0), down);
  ASSERT_EQ(rising.count_converged(), 10);
  ASSERT_EQ(falling.count_converged(), 10);
  int over = 0, straight = 0;
  for (std::size_t k = 0; k < up.size(); ++k) {
    const PoseResult &a = rising.poses[k], &b = falling.poses[up.size() - 1 - k];
    EXPECT_LT((a.X_BA.p - b.X_BA.p).norm(), 1e-9) << k;
    for (const std::size_t strand : {4, 5}) {
      EXPECT_EQ(a.paths[strand].points.size(), b.paths[strand].points.size()) << k;
      (a.paths[strand].points.empty() ? straight : over) += 1;
    }
  }
  EXPECT_GT(over, 0);
  EXPECT_GT(straight, 0);
}

TEST(LinePath, APathOfEquilibriaFollowsItToo) {
  const Model model = knee_led(false);
  EquilibriumSolver solver(model);
  const PoseResult expected = solver.solve(condition_value(0).with(drive_of(model), 0.5));
  solver.reset();
  const SweepResult path = follow_path(solver, condition_value(0), 0, 0.5, 0.1);
  ASSERT_FALSE(path.poses.empty());
  EXPECT_TRUE(path.poses.back().converged()) << path.poses.back().reason;
  EXPECT_LT((path.poses.back().X_BA.p - expected.X_BA.p).norm(), 1e-8);
}

TEST(LinePath, AfterAResetItKnowsNothing) {
  const Model model = knee_led(true);
  EquilibriumSolver solver(model);
  const PoseResult first = solver.solve();
  for (const double flexion : {0.2, 0.6, 1.0})
    (void)solver.solve(condition_value(0).with(drive_of(model), flexion));
  solver.reset();
  const PoseResult again = solver.solve();
  EXPECT_EQ(again.X_BA.p, first.X_BA.p);
  EXPECT_EQ(again.X_BA.R, first.X_BA.R);
  EXPECT_EQ(again.iterations, first.iterations);
}

}  // namespace
}  // namespace condyle
