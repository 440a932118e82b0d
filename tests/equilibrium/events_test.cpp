#include "condyle/equilibrium/events.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "condyle/equilibrium/sweep.h"
#include "condyle/math/rotation.h"
#include "condyle/specimen/fit_surfaces.h"
#include "support/drawer_knee.h"
#include "support/hold.h"
#include "support/report_problems.h"
#include "support/truss.h"

namespace condyle {
namespace {

/// The sweep of one value of a model that is solved everywhere.
SweepResult run(EquilibriumSolver& solver, const Swept& swept, const std::vector<double>& values) {
  const SweepResult result = sweep(solver, swept, values);
  for (const PoseResult& pose : result.poses)
    EXPECT_TRUE(pose.solved()) << pose.value << ": " << pose.reason;
  return result;
}

// The contact of problem 1 carries p(0) = 32.11453374 N [docs/dortmans.md]: a pull of x newtons off
// the wall leaves p(0) - x, so the contact opens at exactly that pull, and closes there on the way
// back.
TEST(Events, ContactOpensWhereThePullEqualsItsForceAndClosesThereAgain) {
  Model model = test::Problem1::model(0, 1);  // a pull of 1 N, scaled by the sweep
  model.start.R = exp_rotation({0, -1.3, 0});
  EquilibriumSolver solver(std::move(model));
  const SweepResult result = run(solver, load_scale(1), {0, 20, 40, 20, 0});
  ASSERT_EQ(result.events.size(), 2u);
  EXPECT_EQ(result.events[0].kind, EventKind::kOpening);
  EXPECT_EQ(result.events[1].kind, EventKind::kClosing);
  // Between the values at which the contact is told to be open and closed lies the tolerance of
  // 1e-9; a gap counts as closed from an overlap of 5e-7/30 L on, and the joint is about 10 N/cm
  // stiff.
  EXPECT_NEAR(result.events[0].value, test::Problem1::p(0), 2e-9);
  EXPECT_NEAR(result.events[1].value, test::Problem1::p(0), 1e-6);
}

TEST(Events, NothingHappensOnAQuietSweep) {
  Model model = test::Problem1::model(0);
  model.start.R = exp_rotation({0, -1.3, 0});
  EquilibriumSolver solver(std::move(model));
  EXPECT_TRUE(run(solver, condition_value(0), {0, 0.5, 1, 1.5}).events.empty());
}

// A stop holds the truss where it is unstable. As the load falls it lifts off where it carries without the stop, and on
// from there only more load would hold it: it snaps up, at the very load.
TEST(Events, AnOpeningFromWhichTheWayLeadsBackIsALimitPoint) {
  constexpr double kHeight = 1;
  ASSERT_LT(kHeight, test::Truss::limit_height());
  for (const double step : {4.0, 1.0, 0.3}) {
    SCOPED_TRACE(step);
    Model model = test::Truss::with_floor();
    model.pairs[0].on_B = make_plane({0, 0, kHeight - 1}, {0, 0, 1});
    model.start.p.z() = kHeight;
    std::vector<double> loads;
    for (double load = 12; load > 0; load -= step) loads.push_back(load);
    EquilibriumSolver solver(std::move(model));
    const SweepResult result = run(solver, load_scale(0), loads);
    ASSERT_EQ(result.events.size(), 2u);
    EXPECT_EQ(result.events[0].kind, EventKind::kOpening);
    EXPECT_EQ(result.events[1].kind, EventKind::kLimitPoint);
    for (const Event& event : result.events)
      EXPECT_NEAR(event.value, test::Truss::load(kHeight), 1e-6);
    for (const PoseResult& pose : result.poses) {
      const bool pressed = pose.value > test::Truss::load(kHeight);
      EXPECT_EQ(pose.contacts[0].closed, pressed) << pose.value;
      // Between the two loads the truss may also rest above the stop.
      EXPECT_EQ(pose.remark.find("second position") != std::string::npos,
                pressed && pose.value < test::Truss::limit_load())
          << pose.value << ": " << pose.remark;
    }
  }
}

// What happens on the branch that it snapped to has its own value.
TEST(Events, AfterASnapAtACornerAreToldWhereTheyAre) {
  constexpr double kStop = 1, kCeiling = 4.6;
  ASSERT_LT(test::Truss::load(kCeiling), test::Truss::load(kStop));
  for (const std::vector<double>& loads :
       {std::vector<double>{12, 8, 4, 0.5}, std::vector<double>{12, 8, 0.5}}) {
    Model model = test::Truss::with_floor();
    model.pairs[0].on_B = make_plane({0, 0, kStop - 1}, {0, 0, 1});
    ContactPair ceiling = model.pairs[0];
    ceiling.name = "ceiling";
    ceiling.on_B = make_plane({0, 0, kCeiling + 1}, {0, 0, -1});
    model.pairs.push_back(ceiling);
    model.start.p.z() = kStop;
    EquilibriumSolver solver(std::move(model));
    const SweepResult result = run(solver, load_scale(0), loads);
    ASSERT_EQ(result.events.size(), 3u);
    EXPECT_EQ(result.events[0].kind, EventKind::kOpening);
    EXPECT_EQ(result.events[1].kind, EventKind::kLimitPoint);
    EXPECT_EQ(result.events[2].kind, EventKind::kClosing);
    EXPECT_EQ(result.events[2].contact, 1);
    EXPECT_NEAR(result.events[0].value, test::Truss::load(kStop), 1e-6);
    EXPECT_NEAR(result.events[2].value, test::Truss::load(kCeiling), 1e-6);
  }
}

const std::vector<double> kFactors = {0, 2. / 3,  4. / 3,  2, 8. / 3, 10. / 3,
                                      4, 14. / 3, 16. / 3, 6, 20. / 3};

// Beyond an edge the way goes on, to a pose that counts for less than one on the surfaces: no branch ends there.
TEST(Events, NoLimitPointIsToldWhereTheWayGoesOnBeyondAnEdge) {
  const Scene scene =
      test::DrawerKnee{{"aMCL", "oMCL", "mCAP", "lCAP"},
                       0,
                       {-30.98241225692403, 123.82618252751358, -157.87768262354703},
                       {-23.591690276489164, -58.356072419255575, 20.125866359379728}}
          .scene(kFactors, false);
  const SweepResult result = sweep(scene, fit_surfaces(scene));
  ASSERT_FALSE(result.events.empty());
  EXPECT_EQ(result.events[0].kind, EventKind::kLeavingPatch);
  EXPECT_TRUE(result.poses.back().converged());
  for (const Event& event : result.events)
    EXPECT_NE(event.kind, EventKind::kLimitPoint) << event.value;
}

// What closes where the body snaps is told there, and not where a gap would have closed before.
TEST(Events, OfASnapHaveItsValueAndAreInOrder) {
  const Scene scene = test::DrawerKnee{
      {"aACL", "pACL", "aPCL", "aMCL", "LCL", "lCAP", "OPL", "APL"},
      60,
      {23.014121430364355, -125.76535885093556, -71.33013841219629},
      {-42.50842377033737, 7.432759117062185,
       179.9101201319507}}.scene(kFactors, false);
  const SweepResult result = sweep(scene, fit_surfaces(scene));
  ASSERT_GE(result.events.size(), 3U);
  EXPECT_EQ(result.events[0].kind, EventKind::kLimitPoint);
  EXPECT_EQ(result.events[1].kind, EventKind::kClosing);
  EXPECT_EQ(result.events[1].value, result.events[0].value);
  EXPECT_TRUE(std::is_sorted(result.events.begin(), result.events.end(),
                             [](const Event& a, const Event& b) { return a.value < b.value; }));
}

// A ball that may only move up and down is carried along over two ridges: the contact jumps from
// one to the other where both are as high.
TEST(Events, AContactThatJumpsBetweenTwoRidgesDoesSoHalfWay) {
  Model model;
  ContactPair pair;
  pair.name = "floor";
  // z = 2 x²/100 - x⁴/10000: ridges at x = -10 and 10.
  pair.on_B = make_polynomial({0, 0, 0}, Eigen::Matrix3d::Identity(),
                              {{2, 0, 0.02}, {4, 0, -0.0001}}, true);
  pair.on_A = make_sphere({0, 0, 0}, 60, true);
  model.pairs = {pair};
  Load weight;
  weight.vector = {0, 0, -10};
  model.loads = {weight};
  model.load_names = {"weight"};
  test::hold(model, ConditionKind::kTranslation, 0, -3);
  test::hold(model, ConditionKind::kTranslation, 1);
  for (int axis = 0; axis < 3; ++axis) test::hold(model, ConditionKind::kRotation, axis);
  model.start.p = {-3, 0, 62};
  model.length = 30;
  EquilibriumSolver solver(std::move(model));
  const SweepResult result = run(solver, condition_value(0), {-3, -1.1, 0.9, 3});
  for (const PoseResult& pose : result.poses) EXPECT_TRUE(pose.converged()) << pose.reason;
  ASSERT_EQ(result.events.size(), 1u);
  EXPECT_EQ(result.events[0].kind, EventKind::kJump);
  // Half way by symmetry, as far as an overlap of 5e-7 mm tells the ridges apart (the gaps differ
  // by 0.3 per mm).
  EXPECT_NEAR(result.events[0].value, 0, 2e-6);
}

// A flat truss snaps through under its limit load, known in closed form, in either direction.
TEST(Events, ASnapThroughIsALimitPoint) {
  using test::Truss;
  EquilibriumSolver solver(Truss::model());
  const SweepResult result = run(solver, load_scale(0), {0, 4, 8, 12, 4, -4, -8, -12});
  EXPECT_LT(result.poses[3].X_BA.p.z(), -Truss::h);
  EXPECT_GT(result.poses.back().X_BA.p.z(), Truss::h);
  ASSERT_EQ(result.events.size(), 2u);
  for (const Event& event : result.events) {
    EXPECT_EQ(event.kind, EventKind::kLimitPoint);
    EXPECT_EQ(event.contact, -1);
  }
  EXPECT_NEAR(result.events[0].value, Truss::limit_load(), 2e-9);
  EXPECT_NEAR(result.events[1].value, -Truss::limit_load(), 2e-9);
}

// Half of the limit load is carried above and below; a step that lands below has missed the way it was on.
TEST(Events, APoseOnAnotherBranchIsNoEventButFoundAnew) {
  using test::Truss;
  EquilibriumSolver solver(Truss::model());
  const Swept press = load_scale(0);
  Walker walker(solver, press, drive_of(solver.model()));
  const double half = Truss::limit_load() / 2;
  SolvedPose start, above, snapped, below;
  start.value = 0, above.value = below.value = half, snapped.value = 2 * Truss::limit_load();
  ASSERT_TRUE(walker.step(0, Patience::kFirst, start));
  ASSERT_TRUE(walker.step(half, Patience::kAll, above));
  ASSERT_TRUE(walker.step(1.2 * Truss::limit_load(), Patience::kAll, snapped));
  ASSERT_TRUE(walker.step(snapped.value, Patience::kAll, snapped));
  ASSERT_TRUE(walker.step(half, Patience::kAll, below));
  ASSERT_LT(below.result.X_BA.p.z(), -Truss::h);
  std::vector<Event> events;
  const std::optional<SolvedPose> there = locate_events(walker, start, below, events).instead;
  ASSERT_TRUE(there);
  EXPECT_NEAR(there->result.X_BA.p.z(), above.result.X_BA.p.z(), 1e-9);
  EXPECT_TRUE(events.empty());
  // Beyond the limit load there is no way on: the limit point is told, and the pose stays.
  EXPECT_FALSE(locate_events(walker, start, snapped, events).instead);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_NEAR(events[0].value, Truss::limit_load(), 2e-9);
}

// Where the apex lands on a floor, the snap and the closing happen at the same load.
TEST(Events, ASnapThroughThatClosesAContactIsBoth) {
  using test::Truss;
  Model model = Truss::with_floor();
  model.pairs[0].on_B = make_plane({0, 0, -3}, {0, 0, 1});  // the ball meets it at z = -2
  EquilibriumSolver solver(std::move(model));
  const SweepResult result = run(solver, load_scale(0), {0, 5, 10});
  ASSERT_EQ(result.events.size(), 2u);
  EXPECT_EQ(result.events[0].kind, EventKind::kLimitPoint);
  EXPECT_EQ(result.events[1].kind, EventKind::kClosing);
  for (const Event& event : result.events) EXPECT_NEAR(event.value, Truss::limit_load(), 2e-9);
  EXPECT_NEAR(result.poses.back().X_BA.p.z(), -2, 1e-9);
}

}  // namespace
}  // namespace condyle
