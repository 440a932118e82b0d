/// The problems of chapter 4 of [Dortmans 1986] as scenes, against their exact answers
/// (docs/dortmans.md). Scenes are in cm, results in mm.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "condyle/equilibrium/sweep.h"
#include "condyle/math/rotation.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/specimen/fit_surfaces.h"
#include "support/report_problems.h"

namespace condyle {
namespace {

constexpr double kExact = 1e-12, kCm = 10;

SweepResult sweep_scene(const std::string& name) {
  const Scene scene =
      read_scene(std::filesystem::path(CONDYLE_SOURCE_DIR) / "data/dortmans" / name);
  const SweepResult result = sweep(scene, fit_surfaces(scene));
  for (const PoseResult& pose : result.poses) EXPECT_TRUE(pose.converged()) << pose.reason;
  return result;
}

/// Relative, of a quantity whose size is `scale` at least.
void expect_exact(double computed, double exact, double scale) {
  EXPECT_NEAR(computed, exact, kExact * std::max(scale, std::abs(exact)));
}

void expect_pose(const PoseResult& pose, const Eigen::Vector3d& centre, double w) {
  for (int i = 0; i < 3; ++i) expect_exact(pose.X_BA.p[i], kCm * centre[i], kCm);
  EXPECT_LT((pose.X_BA.R - exp_rotation({0, w, 0})).norm(), 2 * kExact);
}

void expect_iterations(const SweepResult& result, int most) {
  for (const PoseResult& pose : result.poses)
    EXPECT_LE(pose.iterations, most) << "at " << pose.value;
}

TEST(ReportScenes, Problem1IsExactInFiveIterations) {
  const SweepResult result = sweep_scene("problem1.toml");
  ASSERT_EQ(result.poses.size(), 6u);
  using Exact = test::Problem1;
  for (const PoseResult& pose : result.poses) {
    const double phi = pose.value / kCm;
    expect_pose(pose, {1, 0, phi}, Exact::w(phi));
    expect_exact(pose.contacts[0].force, Exact::p(phi), 1);
    expect_exact(pose.conditions[0].multiplier, Exact::sigma(phi), 50);
    expect_exact(pose.ligaments[0].length, kCm * Exact::L1(phi), kCm);
    expect_exact(pose.ligaments[2].length, kCm * Exact::L3(phi), kCm);
    ASSERT_EQ(pose.contacts[0].points.size(), 1u);
    for (int i = 0; i < 3; ++i)
      expect_exact(pose.contacts[0].points[0].point_ground[i], kCm * Eigen::Vector3d(2, 0, phi)[i],
                   kCm);
  }
  EXPECT_TRUE(result.events.empty());
  expect_iterations(result, 4 + 1);
}

TEST(ReportScenes, Problem2IsExactInThreeIterations) {
  const SweepResult result = sweep_scene("problem2.toml");
  ASSERT_EQ(result.poses.size(), 4u);
  for (const PoseResult& pose : result.poses) {
    const double alpha = pose.value / kCm;
    expect_pose(pose, {alpha, 0, 3}, 0);
    expect_exact(pose.conditions[0].multiplier, -1 - 6 * alpha, 1);
    expect_exact(pose.conditions[1].multiplier, -4, 1);
  }
  expect_iterations(result, 2 + 1);
}

TEST(ReportScenes, Problem3IsExactInFourIterations) {
  const SweepResult result = sweep_scene("problem3.toml");
  ASSERT_EQ(result.poses.size(), 5u);
  for (const PoseResult& pose : result.poses) {
    expect_pose(pose, {0, 0, 7.0 / 3}, pose.value);
    expect_exact(pose.conditions[0].multiplier, kCm * -10 * std::sin(pose.value), kCm);
  }
  expect_iterations(result, 3 + 1);
}

// The wall carries p(0) less the pull.
TEST(ReportScenes, TheCancelledContactOpensAtItsForceAndClosesThereAgain) {
  const SweepResult result = sweep_scene("cancellation.toml");
  ASSERT_EQ(result.poses.size(), 9u);
  const double p = test::Problem1::p(0);
  for (const PoseResult& pose : result.poses) {
    const ContactResult& wall = pose.contacts[0];
    EXPECT_EQ(wall.closed, pose.value < p) << pose.value;
    expect_exact(wall.force, std::max(0.0, p - pose.value), p);
    if (wall.closed)
      expect_pose(pose, {1, 0, 0}, test::Problem1::w(0));
    else
      EXPECT_GT(wall.points.at(0).gap, 1);  // [mm]
  }
  ASSERT_EQ(result.events.size(), 2u);
  EXPECT_EQ(result.events[0].kind, EventKind::kOpening);
  EXPECT_EQ(result.events[1].kind, EventKind::kClosing);
  EXPECT_NEAR(result.events[0].value, p, 2e-9);
  EXPECT_NEAR(result.events[1].value, p, 2e-9);
}

}  // namespace
}  // namespace condyle
