#include "condyle/equilibrium/arc_length.h"
#include "condyle/math/degree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "condyle/equilibrium/sweep.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/specimen/fit_surfaces.h"
#include "condyle/specimen/fit_wraps.h"
#include "support/drawer_knee.h"
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
// A step that passes the last value, turns at the limit point and comes back lies on one side of it at both ends.
TEST(ArcLength, EndsJustBeforeALimitPointWhateverTheStep) {
  for (const double part : {0.9, 0.99, 0.9996, 0.999999})
    for (const double step : {0.1, 0.5, 2.0, 8.0}) {
      EquilibriumSolver solver(Truss::model());
      const double end = part * Truss::limit_load();
      const SweepResult path = follow_path(solver, kPress, 0, end, step);
      EXPECT_TRUE(path.events.empty()) << part << ", " << step;
      EXPECT_EQ(path.poses.back().value, end) << part << ", " << step;
      EXPECT_TRUE(path.poses.back().converged());
      EXPECT_GT(path.poses.back().X_BA.p.z(), Truss::limit_height()) << part << ", " << step;
    }
}

TEST(ArcLength, FindsLimitPointsWhateverTheStep) {
  for (const double step : {0.1, 1.0, 4.0, 16.0, 64.0}) {
    EquilibriumSolver solver(Truss::model());
    PathOptions options;
    options.longest = 1;
    const SweepResult path = follow_path(solver, kPress, 0, 2 * Truss::limit_load(), step, options);
    ASSERT_EQ(path.events.size(), 2u) << step << ": " << path.poses.size() << " poses";
    EXPECT_NEAR(path.events[0].value, Truss::limit_load(), 1e-9) << step;
    EXPECT_NEAR(path.events[1].value, -Truss::limit_load(), 1e-9) << step;
  }
}

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

// A point at the end of a rod of 10 mm, pushed along x: the path is a circle.
TEST(ArcLength, SaysWhereAPathClosesOnItself) {
  Model model;
  for (int i = 0; i < 6; ++i) {
    KinematicCondition hold;
    hold.kind = i < 2 ? ConditionKind::kTranslation : ConditionKind::kRotation;
    hold.axis = Eigen::Vector3d::Unit(i % 2);
    hold.cardan_axis = i < 2 ? 0 : i - 2;
    if (i == 5) {
      hold.kind = ConditionKind::kDistance;
      hold.value = 10;
    }
    model.conditions.push_back(hold);
    model.condition_names.push_back("hold " + std::to_string(i));
  }
  model.start.p = {0, 0, 10};
  model.length = 10;
  EquilibriumSolver solver(std::move(model));
  const SweepResult path = follow_path(solver, condition_value(0), 0, 20, 1);
  const PoseResult& last = path.poses.back();
  EXPECT_EQ(last.status, PoseStatus::kIterationLimit);
  EXPECT_NE(last.reason.find("closes on itself"), std::string::npos) << last.reason;
  EXPECT_LT(path.poses.size(), 100U);
  ASSERT_EQ(path.events.size(), 2U);
  EXPECT_NEAR(path.events[0].value, 10, 1e-9);
  EXPECT_NEAR(path.events[1].value, -10, 1e-9);
}

// A contact that closes beyond an edge leaves nothing before it closes.
TEST(ArcLength, TellsAClosingBeforeWhatTheClosedContactDoes) {
  const test::DrawerKnee knee{{}, 0, {100, 0, 0}, {0, 0, 213}, true};
  std::vector<double> factors;
  for (double factor = 0; factor < 61; factor += 4) factors.push_back(factor);
  const Scene scene = knee.scene(factors, true);
  const SweepResult path = sweep(scene, fit_surfaces(scene));
  bool left = false;
  std::vector<int> open;
  for (const Event& event : path.events) {
    SCOPED_TRACE(event.value);
    if (event.kind == EventKind::kOpening) open.push_back(event.contact);
    if (event.kind == EventKind::kClosing) std::erase(open, event.contact);
    if (event.kind != EventKind::kLeavingPatch) continue;
    left = true;
    EXPECT_EQ(std::count(open.begin(), open.end(), event.contact), 0);
  }
  EXPECT_TRUE(left);
}

// A step may come to another path; up to where contacts change on that one this one cannot be followed.
TEST(ArcLength, TakesAShorterStepWhereOneLeadsToAnotherPath) {
  std::vector<std::vector<double>> told;
  for (const double step : {10.0, 2.0, 0.5}) {
    const test::DrawerKnee knee{{"pACL", "dMCL", "mCAP", "OPL"},
                                20,
                                {-75.0496246596568, -151.62128950149597, 218.28834757369196},
                                {-33.76905847349758, -96.26881073956172, 28.5622875060225},
                                true};
    std::vector<double> factors;
    for (double factor = 0; factor <= 100; factor += step) factors.push_back(factor);
    Scene scene = knee.scene(factors, true);
    ConditionDescription& tie = scene.conditions.emplace_back();
    tie.name = "tie";
    tie.kind = ConditionKind::kDistance;
    tie.value = 60;
    tie.ends = {Attachment{0, {50, 0, 20}}, Attachment{1, {40, 0, 180}}};
    const SweepResult path = sweep(scene, fit_surfaces(scene));
    EXPECT_GT(path.poses.size(), 20U) << step << ": " << path.poses.back().reason;
    told.emplace_back();
    for (const Event& event : path.events) told.back().push_back(event.value);
  }
  ASSERT_GE(told[0].size(), 4U);
  for (std::size_t i = 0; i < 4; ++i)
    for (const int k : {1, 2}) EXPECT_NEAR(told[k].at(i), told[0][i], 1e-6) << i;
}

/// The truss of data/hard that snaps through, pulled by a string over a post as well.
Scene truss_with_string(double from, double to, bool arc_length) {
  const std::filesystem::path file =
      std::filesystem::path(CONDYLE_SOURCE_DIR) / "data/hard/snap-through.toml";
  Scene scene = parse_scene(read_scene(file).text + R"(
[[wrap]]
name = "post"
body = "ground"
kind = "cylinder"
point = [10, 0, 0]
axis = [0, 1, 0]
radius = 3

[[ligament]]
name = "string"
ends = [{ body = "ground", at = [20, 0, 5] }, { body = "apex", at = [0, 0, 0] }]
wraps = ["post"]
law = "toe-linear"
stiffness = 1500
transition_strain = 0.02
slack_length = 20.3
)",
                            file);
  scene.sweep->arc_length = arc_length;
  scene.sweep->values.clear();
  for (int k = 0; k <= 120; ++k) scene.sweep->values.push_back(from + k * (to - from) / 120);
  return scene;
}

// Where the string comes to lie on the post the stiffness jumps, and the path has a corner.
TEST(ArcLength, FollowsAStringOntoWhatItWrapsOn) {
  const SweepResult path = sweep(truss_with_string(0, 60, true), {});
  for (const PoseResult& pose : path.poses) ASSERT_TRUE(pose.converged()) << pose.reason;
  EXPECT_EQ(path.poses.back().value, 60);
  std::vector<double> limits;
  for (const Event& event : path.events)
    if (event.kind == EventKind::kLimitPoint) limits.push_back(event.value);
  ASSERT_EQ(limits.size(), 2U);
  // A sweep in steps snaps at each of them, on its way up and down.
  for (const bool up : {true, false}) {
    const SweepResult steps = sweep(truss_with_string(up ? 0 : 60, up ? 60 : 0, false), {});
    const auto snap =
        std::find_if(steps.events.begin(), steps.events.end(),
                     [](const Event& event) { return event.kind == EventKind::kLimitPoint; });
    ASSERT_NE(snap, steps.events.end());
    EXPECT_NEAR(snap->value, limits[up ? 0 : 1], 1e-7);
  }
}

// A string that pulls hard over a thin post turns the path by more than a right angle, whatever the step.
TEST(ArcLength, TurnsACornerByAnyAngle) {
  std::vector<std::vector<double>> limits;
  for (const int steps : {30, 120, 1000}) {
    Scene scene = truss_with_string(0, 60, true);
    scene.wraps[0].shape = WrapCylinder{0.2};
    scene.wraps[0].placement.p = {1, 0, 1};
    scene.ligaments[2].law = PolynomialLaw{{10, 0.001}, false};  // pulls the same at any length
    scene.sweep->values.clear();
    for (int k = 0; k <= steps; ++k) scene.sweep->values.push_back(60.0 * k / steps);
    const SweepResult path = sweep(scene, {});
    for (std::size_t k = 0; k < path.poses.size(); ++k) {
      ASSERT_TRUE(path.poses[k].converged()) << steps << ": " << path.poses[k].reason;
      if (k == 0) continue;
      EXPECT_LE(std::abs(path.poses[k].value - path.poses[k - 1].value), 1.5 * 60 / steps + 1e-9);
    }
    EXPECT_EQ(path.poses.back().value, 60) << steps;
    limits.emplace_back();
    for (const Event& event : path.events)
      if (event.kind == EventKind::kLimitPoint) limits.back().push_back(event.value);
  }
  ASSERT_EQ(limits[0].size(), limits[2].size());
  ASSERT_EQ(limits[1].size(), limits[2].size());
  for (std::size_t i = 0; i < limits[2].size(); ++i) {
    EXPECT_NEAR(limits[0][i], limits[2][i], 1e-3) << i;
    EXPECT_NEAR(limits[1][i], limits[2][i], 1e-3) << i;
  }
}

// Ligaments on surfaces and contacts beyond an edge are events of a path as of a sweep in steps.
TEST(ArcLength, TellsTheEventsOfASweepInSteps) {
  for (const char* file : {"data/hard/leaving-patch.toml", "data/phantom/wrapped.toml"}) {
    SCOPED_TRACE(file);
    Scene scene = read_scene(std::filesystem::path(CONDYLE_SOURCE_DIR) / file);
    const std::vector<FittedSurface> surfaces = fit_surfaces(scene);
    fit_wraps(scene, surfaces);
    const SweepResult steps = sweep(scene, surfaces);
    scene.sweep->arc_length = true;
    const SweepResult path = sweep(scene, surfaces);
    ASSERT_FALSE(steps.events.empty());
    ASSERT_EQ(path.events.size(), steps.events.size());
    for (std::size_t i = 0; i < path.events.size(); ++i) {
      EXPECT_EQ(path.events[i].kind, steps.events[i].kind);
      EXPECT_EQ(path.events[i].ligament, steps.events[i].ligament);
      EXPECT_NEAR(path.events[i].value, steps.events[i].value, 1e-6);
    }
  }
}

/// The truss with strings that come to lie on posts one after the other as it is pressed down.
Scene truss_over_posts(int posts, bool arc_length) {
  Scene scene = truss_with_string(0, 8, arc_length);
  const WrapDescription post = scene.wraps[0];
  LigamentDescription string = scene.ligaments[2];
  string.law = PolynomialLaw{{0, 1e-6}, false};  // pulls at nothing
  scene.wraps.clear();
  scene.ligaments.pop_back();
  for (int i = 0; i < posts; ++i) {
    scene.wraps.push_back(post);
    scene.wraps.back().name = "post" + std::to_string(i);
    scene.wraps.back().placement.p.z() += 1.36 + 0.0015 * i;
    scene.ligaments.push_back(string);
    scene.ligaments.back().name = "string" + std::to_string(i);
    scene.ligaments.back().path.wraps = {i};
  }
  return scene;
}

TEST(Events, OfOneStepAreToldAllHoweverManyTheyAre) {
  const auto touchings = [](const SweepResult& of) {
    return std::count_if(of.events.begin(), of.events.end(),
                         [](const Event& event) { return event.kind == EventKind::kTouching; });
  };
  const auto fine = touchings(sweep(truss_over_posts(40, false), {}));
  ASSERT_GT(fine, 16);
  for (const bool arc_length : {false, true}) {
    Scene scene = truss_over_posts(40, arc_length);
    scene.sweep->values = {0, 4, 8};
    EXPECT_EQ(touchings(sweep(scene, {})), fine) << arc_length;
  }
}

TEST(ArcLength, TakesAsManyPosesAsItsStepAsksFor) {
  Scene scene = truss_with_string(0, 5, true);
  scene.ligaments.pop_back();
  scene.wraps.clear();
  scene.sweep->values.clear();
  for (int k = 0; k <= 2500; ++k) scene.sweep->values.push_back(0.002 * k);
  const SweepResult path = sweep(scene, {});
  EXPECT_GT(path.poses.size(), 2500U);
  EXPECT_EQ(path.poses.back().value, 5);
  EXPECT_TRUE(path.poses.back().converged()) << path.poses.back().reason;
}

// A load that is huge with factors that are tiny, or the other way round, is the same one.
TEST(Events, AreLocatedWhateverTheSizeOfAVector) {
  for (const double size : {1e7, 1e-7}) {
    SCOPED_TRACE(size);
    Scene scene = truss_with_string(0, 60, false);
    const SweepResult expected = sweep(scene, {});
    scene.loads[0].vector *= size;
    for (double& value : scene.sweep->values) value /= size;
    const SweepResult found = sweep(scene, {});
    ASSERT_EQ(found.events.size(), expected.events.size());
    for (std::size_t i = 0; i < found.events.size(); ++i) {
      EXPECT_EQ(found.events[i].kind, expected.events[i].kind);
      EXPECT_NEAR(found.events[i].value * size, expected.events[i].value, 1e-6);
    }
  }
}

}  // namespace
}  // namespace condyle
