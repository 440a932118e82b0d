/// A sweep that takes over what an earlier one left is the sweep that was never stopped.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "condyle/equilibrium/restore_state.h"
#include "condyle/equilibrium/sweep.h"
#include "condyle/math/rotation.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/specimen/fit_surfaces.h"
#include "support/report_problems.h"
#include "support/same_sweep.h"
#include "support/truss.h"

namespace condyle {
namespace {

using Values = std::vector<double>;

/// Problem 1 pulled off its wall: the contact opens at 32.1145 N.
struct PulledSphere {
  PulledSphere() : solver(model()) {}
  static Model model() {
    Model model = test::Problem1::model(0, 1);
    model.start.R = exp_rotation({0, -1.3, 0});
    return model;
  }
  SweepResult run(const Values& values, std::vector<KnownPose> known = {}) {
    SweepOptions options;
    options.known = std::move(known);
    options.on_computed = [&](const KnownPose& pose) { computed.push_back(pose); };
    return sweep(solver, load_scale(1), values, options);
  }
  EquilibriumSolver solver;
  std::vector<KnownPose> computed;  ///< what the runs computed
};

Values values_of(const std::vector<KnownPose>& poses) {
  Values values;
  for (const KnownPose& known : poses) values.push_back(known.pose.value);
  return values;
}

const Values kThereAndBack = {0, 20, 40, 60, 40, 20, 0};

// That the pose stands on another branch than the one before is known from no number of the pose.
TEST(Resume, KeepsWhatIsSaidOfSecondEquilibriaAndJumps) {
  const Values loads = {-12, -8, -4, 0, 4, 8, 12};
  std::vector<KnownPose> computed;
  SweepOptions options;
  options.on_computed = [&](const KnownPose& pose) { computed.push_back(pose); };
  EquilibriumSolver solver(test::Truss::model());
  const SweepResult whole = sweep(solver, load_scale(0), loads, options);
  for (std::size_t stop = 0; stop <= loads.size(); ++stop) {
    EquilibriumSolver again(test::Truss::model());
    SweepOptions resumed;
    resumed.known.assign(computed.begin(), computed.begin() + static_cast<std::ptrdiff_t>(stop));
    const SweepResult result = sweep(again, load_scale(0), loads, resumed);
    for (std::size_t k = 0; k < loads.size(); ++k)
      EXPECT_EQ(result.poses[k].remark, whole.poses[k].remark) << stop << ", " << loads[k];
  }
}

// What an earlier sweep with other steps said of the pose before is not so any more.
TEST(Resume, TellsOfJumpsFromThePoseThatIsNowBefore) {
  const auto sweep_by = [](double step, std::vector<KnownPose> known) {
    SweepOptions options;
    options.known = std::move(known);
    Values loads;
    for (double load = 0; load < 12.1; load += step) loads.push_back(load);
    EquilibriumSolver solver(test::Truss::model());
    return sweep(solver, load_scale(0), loads, options);
  };
  for (const auto& [earlier, now] : {std::pair(4.0, 1.0), std::pair(0.5, 1.0)}) {
    const SweepResult whole = sweep_by(now, {});
    const SweepResult resumed = sweep_by(now, known_poses(sweep_by(earlier, {})));
    ASSERT_EQ(resumed.poses.size(), whole.poses.size());
    for (std::size_t k = 0; k < whole.poses.size(); ++k)
      EXPECT_EQ(resumed.poses[k].remark, whole.poses[k].remark) << earlier << ", " << k;
  }
}

TEST(Resume, GoesOnWhereTheSweepWasStopped) {
  PulledSphere whole, part, rest;
  const SweepResult uninterrupted = whole.run(kThereAndBack);
  ASSERT_EQ(uninterrupted.events.size(), 2u);
  for (std::size_t stop = 0; stop <= kThereAndBack.size(); ++stop) {
    SCOPED_TRACE(stop);
    std::vector<KnownPose> left = whole.computed;
    left.resize(stop);
    PulledSphere resumed;
    test::expect_same_sweep(uninterrupted, resumed.run(kThereAndBack, left));
    EXPECT_EQ(
        values_of(resumed.computed),
        Values(kThereAndBack.begin() + static_cast<std::ptrdiff_t>(stop), kThereAndBack.end()));
  }
}

TEST(Resume, FillsTheGapsOfACoarserAndNarrowerSweep) {
  PulledSphere coarse, fine, all;
  const SweepResult earlier = coarse.run({10, 30, 50});
  const Values values = {0, 10, 20, 30, 40, 50, 60};
  const SweepResult result = fine.run(values, known_poses(earlier));
  EXPECT_EQ(values_of(fine.computed), (Values{0, 20, 40, 60}));
  test::expect_same_sweep(all.run(values), result);
}

// Between poses that are both known the events are believed, even if they are made up; elsewhere
// they are located.
TEST(Resume, TakesOverTheEventsBetweenKnownPoses) {
  PulledSphere first, second, third;
  SweepResult earlier = first.run({0, 20, 40, 60});
  earlier.events = {{33, EventKind::kJump, 0}};
  const SweepResult same = second.run({0, 20, 40, 60}, known_poses(earlier));
  ASSERT_EQ(same.events.size(), 1u);
  EXPECT_EQ(same.events[0].kind, EventKind::kJump);
  EXPECT_EQ(same.events[0].value, 33);
  const SweepResult finer = third.run({0, 20, 30, 40, 60}, known_poses(earlier));
  ASSERT_EQ(finer.events.size(), 1u);
  EXPECT_EQ(finer.events[0].kind, EventKind::kOpening);
}

TEST(Resume, BelievesAFailure) {
  PulledSphere sphere;
  KnownPose failed;
  failed.pose.value = 20;
  failed.pose.status = PoseStatus::kDiverged;
  failed.pose.reason = "made up";
  const SweepResult result = sphere.run({0, 20, 40}, {failed});
  EXPECT_EQ(result.poses[1].status, PoseStatus::kDiverged);
  EXPECT_EQ(result.poses[1].reason, "made up");
  EXPECT_TRUE(result.poses[2].converged());
  EXPECT_EQ(values_of(sphere.computed), (Values{0, 40}));
}

// A pose that is none of this model's is found out and computed anew.
TEST(Resume, DoesNotBelieveAPoseThatDoesNotFit) {
  PulledSphere first, second;
  std::vector<KnownPose> known = known_poses(first.run({0, 20}));
  known[1].pose.X_BA.p.z() += 0.5;
  const SweepResult result = second.run({0, 20}, known);
  EXPECT_EQ(values_of(second.computed), Values{20});
  EXPECT_LT((result.poses[1].X_BA.p - first.run({20}).poses[0].X_BA.p).norm(), 1e-9);
}

// The nearest known pose is as good a start as the one before.
TEST(Resume, StartsFromTheNearestPoseWhereNoneIsBefore) {
  PulledSphere first, second;
  const std::vector<KnownPose> known = known_poses(first.run({20, 25}));
  const SweepResult result = second.run({18, 19}, known);
  ASSERT_TRUE(result.poses[0].converged());
  EXPECT_LE(result.poses[0].iterations, 2);  // the model's own start takes more
  EXPECT_EQ(KnownPoseIndex(known).nearest_converged(18), &known[0]);
  EXPECT_EQ(KnownPoseIndex(known).nearest_converged(100), &known[1]);
  EXPECT_EQ(KnownPoseIndex({}).nearest_converged(0), nullptr);
}

TEST(Resume, TellsVisitsOfOneValueApart) {
  PulledSphere sphere;
  const std::vector<KnownPose> known = known_poses(sphere.run({0, 20, 0, 20, 20}));
  const KnownPoseIndex index(known);
  EXPECT_EQ(index.find(20, 0), &known[1]);
  EXPECT_EQ(index.find(20, 1), &known[3]);
  EXPECT_EQ(index.find(20 * (1 + 1e-15), 2), &known[4]);
  EXPECT_EQ(index.find(20, 3), nullptr);
  EXPECT_EQ(index.find(20.001, 0), nullptr);
}

TEST(RestoreState, NeedsOnlyThePolishOfRoundOff) {
  PulledSphere sphere;
  const PoseResult pose = sphere.run({10}).poses[0];
  ASSERT_TRUE(can_restore(sphere.solver.model(), pose));
  const EquilibriumState state = restore_state(sphere.solver.model(), pose);
  ASSERT_EQ(state.contacts.size(), 1u);
  PulledSphere other;
  const Drive drive = load_scale(1).with(drive_of(other.solver.model()), 10);
  other.solver.set_state(state, drive);
  const PoseResult again = other.solver.solve(drive);
  EXPECT_LE(again.iterations, 1);
  EXPECT_LT((again.X_BA.p - pose.X_BA.p).norm(), 1e-14);
}

TEST(RestoreState, NeedsAPoseThatIsThere) {
  PulledSphere sphere;
  PoseResult pose = sphere.run({10}).poses[0];
  pose.X_BA.p.x() = NAN;
  EXPECT_FALSE(can_restore(sphere.solver.model(), pose));
  EXPECT_FALSE(can_restore(sphere.solver.model(), PoseResult()));
}

TEST(Resume, OfThePhantomIsTheSweepThatWasNeverStopped) {
  Scene scene = read_scene(std::filesystem::path(CONDYLE_SOURCE_DIR) / "data/phantom/knee.toml");
  const std::vector<FittedSurface> surfaces = fit_surfaces(scene);
  const SweepResult whole = sweep(scene, surfaces);
  for (const std::size_t stop : {1u, 7u, 24u}) {
    SCOPED_TRACE(stop);
    SweepOptions options;
    options.known = known_poses(whole);
    options.known.resize(stop);
    std::size_t computed = 0;
    options.on_computed = [&](const KnownPose&) { ++computed; };
    test::expect_same_sweep(whole, sweep(scene, surfaces, options));
    EXPECT_EQ(computed, 25 - stop);
  }
}

/// Of a layered contact: the same lattice, told by its points, and the same pose on it.
void expect_same_layers(const PoseResult& expected, const PoseResult& pose) {
  ASSERT_EQ(pose.status, expected.status);
  if (!expected.converged()) return;
  EXPECT_LT((pose.X_BA.p - expected.X_BA.p).norm(), 1e-9);
  EXPECT_LT((pose.X_BA.R - expected.X_BA.R).norm(), 1e-11);
  for (std::size_t i = 0; i < expected.contacts.size(); ++i) {
    ASSERT_EQ(pose.contacts[i].layer.has_value(), expected.contacts[i].layer.has_value());
    if (!expected.contacts[i].layer) continue;
    EXPECT_EQ(pose.contacts[i].layer->points, expected.contacts[i].layer->points);
    EXPECT_EQ(pose.contacts[i].pressures.size(), expected.contacts[i].pressures.size());
  }
}

// The sum over the points of a layer changes its last digits with the way to a pose, and its derivatives more of them.
TEST(Resume, OfLayersIsTheSweepThatWasNeverStopped) {
  Scene scene = read_scene(std::filesystem::path(CONDYLE_SOURCE_DIR) / "data/phantom/layered.toml");
  const std::vector<FittedSurface> surfaces = fit_surfaces(scene);
  SweepOptions options;
  options.stability = true;
  const SweepResult whole = sweep(scene, surfaces, options);
  options.known = known_poses(whole);
  options.known.resize(whole.poses.size() / 2);
  std::size_t computed = 0;
  options.on_computed = [&](const KnownPose&) { ++computed; };
  const SweepResult resumed = sweep(scene, surfaces, options);
  EXPECT_EQ(computed, whole.poses.size() - options.known.size());
  for (std::size_t i = 0; i < options.known.size(); ++i) {
    const PoseResult &expected = whole.poses[i], &pose = resumed.poses[i];
    ASSERT_EQ(pose.status, expected.status) << i;
    if (!expected.converged()) continue;
    EXPECT_EQ(pose.lowest_stiffness, expected.lowest_stiffness) << i;
    ASSERT_TRUE(pose.joint_stiffness && expected.joint_stiffness);
    EXPECT_EQ(pose.joint_stiffness->stiffness, expected.joint_stiffness->stiffness) << i;
    EXPECT_EQ(pose.joint_stiffness->compliance, expected.joint_stiffness->compliance) << i;
  }
  for (std::size_t i = 0; i < whole.poses.size(); ++i) {
    SCOPED_TRACE(i);
    expect_same_layers(whole.poses[i], resumed.poses[i]);
  }
}

// Where a way to a pose begins says how many points are pressed there, and the lattice is chosen by that of the pose itself.
TEST(Resume, OfLayersNoPoseDependsOnThoseBefore) {
  const Scene up =
      read_scene(std::filesystem::path(CONDYLE_SOURCE_DIR) / "data/phantom/layered.toml");
  const std::vector<FittedSurface> surfaces = fit_surfaces(up);
  Scene down = up;
  std::reverse(down.sweep->values.begin(), down.sweep->values.end());
  const SweepResult whole = sweep(up, surfaces), other = sweep(down, surfaces);
  ASSERT_EQ(whole.poses.size(), other.poses.size());
  for (std::size_t i = 0; i < whole.poses.size(); ++i) {
    SCOPED_TRACE(i);
    expect_same_layers(whole.poses[i], other.poses[other.poses.size() - 1 - i]);
  }
}

}  // namespace
}  // namespace condyle
