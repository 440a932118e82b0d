/// By which way a pose was found, and what each iteration left.

#include "condyle/equilibrium/pose_trace.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "condyle/equilibrium/arc_length.h"
#include "condyle/equilibrium/sweep.h"
#include "condyle/math/degree.h"
#include "condyle/math/rotation.h"
#include "support/quadric_knee.h"
#include "support/report_problems.h"
#include "support/truss.h"

namespace condyle {
namespace {

std::vector<double> residuals(const PoseResult& pose) {
  return {pose.trace.residuals.begin(), pose.trace.residuals.end()};
}

PoseResult at_flexion(EquilibriumSolver& solver, double degrees) {
  return solver.solve(condition_value(0).with(drive_of(solver.model()), kDegree * degrees));
}

std::string way(const PoseResult& pose) { return in_words(pose.trace); }

// r_{k+1} <= C r_k²: the ratio of the logarithms' differences is that of an order of two, so C
// found from one pair of residuals holds for the next, to within what varies along the way.
TEST(PoseTrace, NewtonConvergesQuadraticallyOnExactSurfaces) {
  EquilibriumSolver solver(test::quadric_knee());
  ASSERT_TRUE(at_flexion(solver, 30).converged());
  const PoseResult pose = at_flexion(solver, 40);
  ASSERT_TRUE(pose.converged());
  EXPECT_EQ(way(pose), "Newton from the pose before it");
  const std::vector<double> r = residuals(pose);
  ASSERT_GE(r.size(), 4U);
  EXPECT_EQ(static_cast<int>(r.size()), pose.iterations + 1);
  EXPECT_LT(r.back(), 1e-12);
  constexpr double kRoundOff = 1e-12;
  for (std::size_t k = 1; k + 1 < r.size(); ++k)
    EXPECT_LT(r[k + 1], 30 * r[k] * r[k] + kRoundOff) << k << ": " << r[k];
}

// The second step in line is extrapolated, and needs no more iterations.
TEST(PoseTrace, PosesOfASweepInStepsAreExtrapolated) {
  EquilibriumSolver solver(test::quadric_knee());
  int without = 0;
  (void)at_flexion(solver, 0);
  for (int k = 1; k <= 6; ++k) {
    const PoseResult pose = at_flexion(solver, 5 * k);
    EXPECT_EQ(way(pose), k == 1 ? "Newton from the pose before it"
                                : "Newton from the poses before it, extrapolated");
    if (k == 1) without = pose.trace.residuals.size();
    if (k > 2) {
      EXPECT_LE(pose.trace.residuals.size(), without) << k;
    }
  }
}

TEST(PoseTrace, ADisplacedStartIsFoundByTheDescent) {
  Model model = test::quadric_knee();
  model.start = {exp_rotation(kDegree * Eigen::Vector3d(2, -5, 6)), {6, -5, -7}};
  EquilibriumSolver solver(model);
  const PoseResult pose = solver.solve();
  ASSERT_TRUE(pose.converged()) << pose.reason;
  EXPECT_EQ(pose.trace.route, PoseRoute::kDescent);
  EXPECT_EQ(pose.trace.origin, PoseOrigin::kStart);
  EXPECT_GT(pose.trace.searches, 2);
  EXPECT_LT(residuals(pose).back(), 1e-12);
}

// It is counted what searches look at, whatever was looked at for other poses before.
TEST(PoseTrace, ADescentIsGivenUpAfterSoManyPointsLookedAt) {
  Model model = test::quadric_knee();
  model.start = {exp_rotation(kDegree * Eigen::Vector3d(2, -5, 6)), {6, -5, -7}};
  EquilibriumSolver patient(model);
  ASSERT_TRUE(patient.solve().converged());
  const long needed = patient.spent().points;
  EXPECT_GT(needed, 1000);
  EquilibriumOptions options;
  options.most_at_first.points = needed / 4;
  EquilibriumSolver hasty(model, options);
  for (int k = 0; k < 2; ++k) {
    const PoseResult pose = hasty.solve();
    EXPECT_EQ(pose.status, PoseStatus::kIterationLimit) << pose.reason;
    EXPECT_LT(hasty.spent().points, needed);
  }
}

TEST(PoseTrace, APoseThatLeadsToOthersMayTakeLonger) {
  Model model = test::quadric_knee();
  model.start = {exp_rotation(kDegree * Eigen::Vector3d(2, -5, 6)), {6, -5, -7}};
  EquilibriumOptions options;
  options.most.points = 1000;
  EquilibriumSolver solver(model, options);
  const Drive drive = drive_of(solver.model());
  EXPECT_EQ(solver.solve(drive, Patience::kAll).status, PoseStatus::kIterationLimit);
  EXPECT_TRUE(solver.solve(drive, Patience::kFirst).converged());
}

// What its iterations take the time of is not left for points.
TEST(PoseTrace, IterationsTakeOfThePointsThatMayBeLookedAt) {
  const Work left = Work{450, 450000}.after({100, 50000});
  EXPECT_EQ(left.iterations, 350);
  EXPECT_EQ(left.points, 400000 - 100 * Work::kPointsOfAnIteration);
  EXPECT_FALSE((Work{450, 450000}.after({440, 320000}).any()));
}

// Of a contact that is held closed all of both surfaces is looked at, but not for each of the descent's steps.
TEST(PoseTrace, ContactsHeldClosedAreFoundWithFewPoints) {
  Model model = test::quadric_knee();
  for (ContactPair& pair : model.pairs) pair.mode = ContactMode::kClosed;
  EquilibriumSolver solver(model);
  ASSERT_TRUE(solver.solve().converged());
  EXPECT_LT(solver.spent().points, 100000);  // 33,000; it was 455,000
}

// The start stands at 90 degrees of a flexion of 0: its contacts are found by the descent at its own
// value, and the way from there is taken in parts.
TEST(PoseTrace, AStartFarFromItsValuesIsLeftInParts) {
  Model model = test::quadric_knee();
  EquilibriumSolver at_90(model);
  (void)at_flexion(at_90, 45);
  const PoseResult there = at_flexion(at_90, 90);
  ASSERT_TRUE(there.converged());
  model.start = there.X_BA;
  EquilibriumSolver solver(model);
  const PoseResult pose = solver.solve();
  ASSERT_TRUE(pose.converged()) << pose.reason;
  EXPECT_EQ(pose.trace.route, PoseRoute::kPartsDescents);
  EXPECT_EQ(pose.trace.origin, PoseOrigin::kStart);
  EXPECT_GE(pose.trace.parts, 2);
  EXPECT_EQ(way(pose), "in " + std::to_string(pose.trace.parts) +
                           " parts, with descents from the start pose of the scene");
}

// A ball pulled off its wall: Newton's contact pulls and is released, once.
TEST(PoseTrace, CountsContactsThatAreReleasedAndClosed) {
  Model model = test::Problem1::model(0, 1);
  model.start.R = exp_rotation({0, -1.3, 0});
  EquilibriumSolver solver(model);
  const Swept load = load_scale(1);
  const Drive drive = drive_of(solver.model());
  const PoseResult touching = solver.solve(load.with(drive, 30));
  const PoseResult released = solver.solve(load.with(drive, 40));
  const PoseResult again = solver.solve(load.with(drive, 30));
  ASSERT_TRUE(touching.converged() && released.converged() && again.converged());
  EXPECT_TRUE(touching.contacts[0].closed && again.contacts[0].closed);
  EXPECT_FALSE(released.contacts[0].closed);
  EXPECT_EQ(released.trace.openings, 1);
  EXPECT_EQ(released.trace.closings, 0);
  EXPECT_EQ(again.trace.openings, 0);
  EXPECT_EQ(again.trace.closings, 1);
}

TEST(PoseTrace, APoseThatIsNotFoundKeepsTheResidualsOfItsLastTry) {
  Model model = test::quadric_knee();
  model.loads[0].vector = -20 * model.loads[0].vector;  // pulls the tibia away
  model.elements.clear();
  model.element_names.clear();
  EquilibriumSolver solver(model);
  const PoseResult pose = solver.solve();
  ASSERT_FALSE(pose.converged());
  EXPECT_EQ(pose.trace.route, PoseRoute::kNone);
  EXPECT_EQ(way(pose), "-");
}

TEST(PoseTrace, OfAPathSaysSo) {
  EquilibriumSolver solver(test::Truss::model());
  const SweepResult path = follow_path(solver, load_scale(0), -12, 12, 4);
  ASSERT_TRUE(path.poses.back().converged());
  for (std::size_t k = 1; k < path.poses.size(); ++k)
    EXPECT_EQ(path.poses[k].trace.origin, PoseOrigin::kPath);
}

// Past the limit load the truss goes to its other branch, and not by Newton from the pose before.
TEST(PoseTrace, OfAResumedSweepIsThatOfTheFirstOne) {
  const std::vector<double> loads = {-12, -8, -4, 0, 4, 8, 12};
  EquilibriumSolver solver(test::Truss::model()), again(test::Truss::model());
  const SweepResult whole = sweep(solver, load_scale(0), loads);
  SweepOptions options;
  options.known = known_poses(whole);
  options.known[2].pose.trace = PoseTrace();  // of a run that told none
  const SweepResult resumed = sweep(again, load_scale(0), loads, options);
  for (std::size_t k = 0; k < loads.size(); ++k) {
    SCOPED_TRACE(loads[k]);
    const PoseTrace &a = whole.poses[k].trace, &b = resumed.poses[k].trace;
    if (k == 2) {
      EXPECT_EQ(way(resumed.poses[k]), "Newton from the same pose of an earlier run");
      continue;
    }
    EXPECT_EQ(a.route, b.route);
    EXPECT_EQ(a.origin, b.origin);
    EXPECT_EQ(a.searches, b.searches);
    EXPECT_EQ(residuals(whole.poses[k]), residuals(resumed.poses[k]));
  }
}

TEST(ResidualHistory, KeepsTheLastOfMoreThanFit) {
  ResidualHistory history;
  for (int k = 0; k < ResidualHistory::kMost + 5; ++k) history.add(k);
  EXPECT_EQ(history.size(), ResidualHistory::kMost);
  EXPECT_EQ(history[0], 0);
  EXPECT_EQ(history[ResidualHistory::kMost - 1], ResidualHistory::kMost + 4);
}

}  // namespace
}  // namespace condyle
