#include "condyle/contact/line_contact.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>

#include "condyle/equilibrium/contact_shape.h"
#include "condyle/equilibrium/equilibrium_solver.h"
#include "condyle/equilibrium/model_covers.h"
#include "condyle/math/rotation.h"
#include "condyle/surface/exact_surfaces.h"
#include "support/hold.h"

namespace condyle {
namespace {

std::optional<Objection> objection_anew(const Model& model, const RigidTransform& X) {
  std::vector<ContactSearch> searches = make_searches(model, cover_pairs(model));
  return objection_at(model, searches, X);
}

using Eigen::Vector3d;
using test::hold;

/// A roller of radius 10 and length 30 along x over the floor z = 0, everything turned by X. Its
/// weight of 12 N acts `off` from its middle, 2 mm below its axis.
Model roller(double off, const RigidTransform& X = {}, double floor_radius = kUnbounded) {
  Model model;
  ContactPair pair;
  pair.name = "floor";
  pair.on_B = make_plane(X.p, X.R.col(2), floor_radius);
  pair.on_A = make_cylinder({0, 0, 0}, {1, 0, 0}, 10, true, 30);
  model.pairs = {pair};
  Load weight;
  weight.vector = X.R * Vector3d(0, 0, -12);
  weight.at = {off, 0, -2};
  model.loads = {weight};
  model.load_names = {"weight"};
  model.start = X * RigidTransform{Eigen::Matrix3d::Identity(), {0, 0, 11}};
  model.length = 15;
  return model;
}

/// Springs that hold x, y and yaw; at the height of the axis they pull neither up nor down.
void tether(Model& model, const RigidTransform& X = {}) {
  for (const double x : {-12.0, 12.0}) {
    for (const double y : {-5.0, 5.0}) {
      LineElement& element = model.elements.emplace_back();
      element.x_C = X * Vector3d(x, y, 10);
      element.s_D = {x, 0, 0};
      element.law = PolynomialLaw{{0, 0.5}, false};
      model.element_names.emplace_back("tether");
    }
  }
}

/// Forces at the ends, the one with the smaller coordinate along `axis` first.
std::array<ContactPointResult, 2> ends_of(const PoseResult& pose, const Vector3d& axis) {
  const std::vector<ContactPointResult>& points = pose.contacts[0].points;
  if (points.size() != 2) {
    ADD_FAILURE() << points.size() << " points";
    return {};
  }
  const bool ordered = points[0].point_ground.dot(axis) < points[1].point_ground.dot(axis);
  return {points[ordered ? 0 : 1], points[ordered ? 1 : 0]};
}

// The lever rule: 12 N acting 5 mm beside the middle of a line of 30 mm share out as 4 and 8 N.
TEST(LineContact, ARollerOnAFloorIsCarriedByItsEnds) {
  Model model = roller(5);
  tether(model);
  EquilibriumSolver solver(model);
  const PoseResult pose = solver.solve();
  ASSERT_TRUE(pose.converged()) << pose.reason;
  EXPECT_EQ(pose.contacts[0].shape, ContactShape::kLine);
  const auto [low, high] = ends_of(pose, Vector3d::UnitX());
  EXPECT_NEAR(low.force, 4, 1e-9);
  EXPECT_NEAR(high.force, 8, 1e-9);
  const double x = pose.X_BA.p.x();
  EXPECT_NEAR(low.point_ground.x(), x - 15, 1e-9);
  EXPECT_NEAR(high.point_ground.x(), x + 15, 1e-9);
  EXPECT_NEAR(pose.X_BA.p.z(), 10, 1e-11);
  EXPECT_NEAR((pose.X_BA.R * Vector3d::UnitX()).z(), 0, 1e-12);
  EXPECT_NEAR(pose.contacts[0].force, 12, 1e-9);
  EXPECT_NEAR(pose.contacts[0].resultant_ground.x(), x + 5, 1e-9);
  EXPECT_NEAR(low.relative_curvature[0], 0, 1e-15);
  EXPECT_NEAR(low.relative_curvature[1], 0.1, 1e-15);
}

// From a place that is an end itself the line goes on in one direction only; a long model has wide spacings.
TEST(LineContact, BothEndsAreFoundFromEitherOfThem) {
  const Model model = roller(0);
  const RigidTransform X{exp_rotation({0, 0, 0.3}), {1, 2, 10}};
  const ContactPair& pair = model.pairs[0];
  for (const double inside : {0.0, kWithinEdge, kWithinEdge + 1e-15, 1e-7, 3.0})
    for (const double end : {-1.0, 1.0})
      for (const double spacing : {1.2, 24.0}) {
        const Vector3d on_A(end * (15 - inside), 0, -10), on_B = X * on_A;
        std::array<GapMinimum, 2> ends;
        ASSERT_TRUE(find_line_ends(pair, {{on_B}, {on_A}}, X, spacing, ends)) << inside;
        EXPECT_NEAR((ends[1].point_B - ends[0].point_B).norm(), 30, 1e-8)
            << inside << ", " << end << ", " << spacing;
      }
}

// Far and askew at first: the descent has to lay it down.
TEST(LineContact, IsFoundFromAfar) {
  Model model = roller(5);
  tether(model);
  model.start.p = {3, -4, 18};
  model.start.R = exp_rotation({0.3, 0.2, -0.25});
  EquilibriumSolver solver(model);
  const PoseResult pose = solver.solve();
  ASSERT_TRUE(pose.converged()) << pose.reason;
  const auto [low, high] = ends_of(pose, Vector3d::UnitX());
  EXPECT_NEAR(low.force, 4, 1e-9);
  EXPECT_NEAR(high.force, 8, 1e-9);
}

TEST(LineContact, TurnsWithTheScene) {
  const RigidTransform X{exp_rotation({0.7, -1.1, 0.4}), {30, -20, 50}};
  Model straight = roller(-3), turned = roller(-3, X);
  tether(straight);
  tether(turned, X);
  const PoseResult a = EquilibriumSolver(straight).solve(), b = EquilibriumSolver(turned).solve();
  ASSERT_TRUE(a.converged()) << a.reason;
  ASSERT_TRUE(b.converged()) << b.reason;
  EXPECT_LT((b.contacts[0].resultant_ground - X * a.contacts[0].resultant_ground).norm(), 1e-8);
  const auto ends_a = ends_of(a, Vector3d::UnitX()), ends_b = ends_of(b, X.R.col(0));
  for (const std::size_t k : {0, 1}) {
    EXPECT_NEAR(ends_a[k].force, ends_b[k].force, 1e-9);
    EXPECT_LT((ends_b[k].point_ground - X * ends_a[k].point_ground).norm(), 1e-8);
  }
}

// The floor is known within 9 mm of the origin only: the line is its chord under the axis.
TEST(LineContact, EndsWhereTheKnownFloorEnds) {
  Model model = roller(2, {}, 9);
  tether(model);
  EquilibriumSolver solver(model);
  const PoseResult pose = solver.solve();
  ASSERT_TRUE(pose.converged()) << pose.reason;
  const auto [low, high] = ends_of(pose, Vector3d::UnitX());
  EXPECT_NEAR(low.point_ground.x(), -9, 1e-8);
  EXPECT_NEAR(high.point_ground.x(), 9, 1e-8);
  const double at = pose.X_BA.p.x() + 2;
  EXPECT_NEAR(high.force, 12 * (at + 9) / 18, 1e-7);
}

// Pushed along its axis over the edge of the floor the roller's own end takes over from the
// floor's: from x = 6 on the line begins at x - 15. The weight acts at x - 5.
TEST(LineContact, OneEndTakesOverFromAnother) {
  Model model = roller(-5, {}, 9);
  hold(model, ConditionKind::kTranslation, 0);
  hold(model, ConditionKind::kTranslation, 1);
  hold(model, ConditionKind::kRotation, 2);
  EquilibriumSolver solver(model);
  for (const double x : {0.0, 3.0, 5.9, 6.5, 10.0, 4.0}) {
    const PoseResult pose = solver.solve(condition_value(0).with(drive_of(solver.model()), x));
    ASSERT_TRUE(pose.converged()) << x << ": " << pose.reason;
    const auto [low, high] = ends_of(pose, Vector3d::UnitX());
    const double first = std::max(-9.0, x - 15);
    EXPECT_NEAR(low.point_ground.x(), first, 1e-8) << x;
    EXPECT_NEAR(high.point_ground.x(), 9, 1e-8) << x;
    EXPECT_NEAR(high.force, 12 * (x - 5 - first) / (9 - first), 1e-7) << x;
    EXPECT_NEAR(low.force + high.force, 12, 1e-9) << x;
  }
  // At x = 16 the weight lies 2 mm beyond the floor.
  EXPECT_FALSE(solver.solve(condition_value(0).with(drive_of(solver.model()), 16)).converged());
}

// Two rollers with parallel axes; yaw and y are prescribed, for on its own the upper one rolls off.
TEST(LineContact, TwoParallelRollers) {
  Model model = roller(5);
  model.pairs[0].on_B = make_cylinder({4, 0, -6}, {1, 0, 0}, 6, true, 40);
  hold(model, ConditionKind::kTranslation, 0);
  hold(model, ConditionKind::kTranslation, 1);
  hold(model, ConditionKind::kRotation, 0);
  hold(model, ConditionKind::kRotation, 2);
  EquilibriumSolver solver(model);
  const PoseResult pose = solver.solve();
  ASSERT_TRUE(pose.converged()) << pose.reason;
  EXPECT_EQ(pose.contacts[0].shape, ContactShape::kLine);
  const auto [low, high] = ends_of(pose, Vector3d::UnitX());
  EXPECT_NEAR(low.point_ground.x(), -15, 1e-8);
  EXPECT_NEAR(high.point_ground.x(), 15, 1e-8);
  EXPECT_NEAR(low.force, 4, 1e-8);
  EXPECT_NEAR(high.force, 8, 1e-8);
  EXPECT_NEAR(low.relative_curvature[1], 0.1 + 1. / 6, 1e-14);
}

// In a hollow cylinder a roller needs nothing to lie still but its weight (and something along the
// axis): height, tilt, yaw and side are held by the two ends.
TEST(LineContact, ARollerFindsTheBottomOfAHollow) {
  Model model = roller(5);
  model.pairs[0].on_B = make_cylinder({0, 0, 25}, {1, 0, 0}, 25, false, 60);
  hold(model, ConditionKind::kTranslation, 0, 2);
  model.start.p = {2, 3, 12};
  model.start.R = exp_rotation({0.1, 0.05, 0.1});
  EquilibriumSolver solver(model);
  const PoseResult pose = solver.solve();
  ASSERT_TRUE(pose.converged()) << pose.reason;
  const auto [low, high] = ends_of(pose, Vector3d::UnitX());
  EXPECT_NEAR(low.force, 4, 1e-8);
  EXPECT_NEAR(high.force, 8, 1e-8);
  EXPECT_LT((pose.X_BA.p - Vector3d(2, 0, 10)).norm(), 1e-8);
}

// The weight acts 4 mm beyond the end: nothing at the other end pulls the roller down.
TEST(LineContact, ARollerTipsOverItsEnd) {
  for (const double off : {19.0, -19.0}) {
    Model model = roller(off);
    tether(model);
    EXPECT_FALSE(EquilibriumSolver(model).solve().converged());
  }
}

// Turned by 0.1 about y, the end at +15 touches the floor and the other is 30 sin 0.1 above it.
TEST(LineContact, ARollerOnTheEndOfItsLineIsNamed) {
  const RigidTransform X{exp_rotation({0, 0.1, 0}),
                         {0, 0, 15 * std::sin(0.1) + 10 * std::cos(0.1) - 1e-9}};
  const std::optional<Objection> objection = objection_anew(roller(19), X);
  ASSERT_TRUE(objection);
  EXPECT_EQ(objection->status, PoseStatus::kLeftPatch);
  EXPECT_NE(objection->reason.find("contact \"floor\""), std::string::npos) << objection->reason;
  EXPECT_NE(objection->reason.find("tips over"), std::string::npos) << objection->reason;
  EXPECT_FALSE(objection_anew(roller(19), {Eigen::Matrix3d::Identity(), {0, 0, 10}}));
}

// A line that is held level by a condition as well shares its load with it in a way that statics
// cannot tell.
TEST(LineContact, ARollerThatIsAlsoHeldLevelIsUndetermined) {
  Model model = roller(0);
  tether(model);
  hold(model, ConditionKind::kRotation, 1);
  EquilibriumSolver solver(model);
  const PoseResult pose = solver.solve();
  EXPECT_EQ(pose.status, PoseStatus::kSingular);
  EXPECT_NE(pose.reason.find("\"hold\" and contact \"floor\" depend on each other"),
            std::string::npos)
      << pose.reason;
}

// All turns are held, so one point of the line is enough to carry, wherever along it: beyond the floor's edge as well.
TEST(LineContact, ALineThatOnePointCarriesIsUndetermined) {
  Model model = roller(0, {}, 15);
  for (const int axis : {0, 1}) hold(model, ConditionKind::kTranslation, axis);
  for (const int axis : {0, 1, 2}) hold(model, ConditionKind::kRotation, axis);
  EquilibriumSolver solver(model);
  for (const double x : {-3.0, -1.0, 0.0, 2.0}) {
    const PoseResult pose = solver.solve(condition_value(0).with(drive_of(solver.model()), x));
    EXPECT_EQ(pose.status, PoseStatus::kSingular) << x;
    EXPECT_NE(pose.reason.find("\"floor\""), std::string::npos) << pose.reason;
  }
}

// Where the roller may tilt, one point balances only a load right over it: over an end, or where the first estimate happened to
// be. The ends share it as when two points were solved for.
TEST(LineContact, OnePointUnderTheLoadIsALineToo) {
  for (const double off : {0.0, 5.0, 15.0, -15.0})
    for (const bool one : {false, true}) {
      Model model = roller(off);
      for (const int axis : {0, 1}) hold(model, ConditionKind::kTranslation, axis);
      for (const int axis : {0, 2}) hold(model, ConditionKind::kRotation, axis);
      EquilibriumSolver solver(model);
      const Drive drive = drive_of(solver.model());
      if (one) {
        EquilibriumState state;
        state.X.p.z() = 10;
        state.contacts = {{0, {{Vector3d(off, 0, 0)}, {Vector3d(off, 0, -10)}}, 12}};
        state.sigma.assign(4, 0);
        solver.set_state(state, drive);
      }
      const PoseResult pose = solver.solve(drive);
      ASSERT_TRUE(pose.converged()) << off << one << pose.reason;
      EXPECT_EQ(pose.contacts[0].shape, ContactShape::kLine);
      const auto [low, high] = ends_of(pose, Vector3d::UnitX());
      EXPECT_NEAR(low.force, 12 * (15 - off) / 30, 1e-8) << off << one;
      EXPECT_NEAR(high.force, 12 * (15 + off) / 30, 1e-8) << off << one;
    }
}

void expect_conforming(const std::optional<Objection>& objection) {
  ASSERT_TRUE(objection);
  EXPECT_EQ(objection->status, PoseStatus::kSingular);
  EXPECT_EQ(objection->reason,
            "contact \"floor\": the surfaces conform, rigid contact does not say where they touch");
}

TEST(LineContact, ABallInACupOfItsRadiusConforms) {
  Model model = roller(0);
  model.pairs[0].on_B = make_sphere({0, 0, 10}, 10, false);
  model.pairs[0].on_A = make_sphere({0, 0, 0}, 10, true);
  for (int k = 0; k < 3; ++k) hold(model, ConditionKind::kRotation, k);
  EquilibriumSolver solver(model);
  EXPECT_FALSE(solver.solve().converged());
  expect_conforming(objection_anew(model, {Eigen::Matrix3d::Identity(), {0, 0, 10}}));
}

TEST(LineContact, APlaneOnAPlaneConforms) {
  Model model = roller(0);
  model.pairs[0].on_A = make_plane({0, 0, -10}, {0, 0, -1}, 12);
  hold(model, ConditionKind::kTranslation, 0);
  hold(model, ConditionKind::kTranslation, 1);
  for (int k = 0; k < 3; ++k) hold(model, ConditionKind::kRotation, k);
  EquilibriumSolver solver(model);
  const PoseResult pose = solver.solve();
  expect_conforming(Objection{pose.status, pose.reason});
}

// Curvature zero is not enough: the gap x⁴ + y² opens beside its one point.
TEST(LineContact, AFlatPointThatIsIsolatedIsNoLine) {
  ContactPair pair;
  pair.on_B = make_plane({0, 0, 0}, {0, 0, 1});
  pair.on_A = make_polynomial({0, 0, 0}, exp_rotation({M_PI, 0, 0}), {{4, 0, -1e-3}, {0, 2, -0.05}},
                              true, 15);
  const RigidTransform X;
  const ContactLinearization at = linearize_contact(pair, {Place{{0, 0, 0}}, Place{{0, 0, 0}}}, X);
  ASSERT_NEAR(at.relative_curvature[0], 0, 1e-15);
  EXPECT_EQ(examine_touch(pair, at, {Place{{0, 0, 0}}, Place{{0, 0, 0}}}, X, 15).kind,
            Touch::kPoint);
}

// A torus lies on a plane along a ring.
TEST(LineContact, ATorusOnAPlaneIsALineWithoutEnds) {
  Model model = roller(0);
  model.pairs[0].on_A = make_torus({0, 0, 0}, {0, 0, 1}, 20, 10, true);
  hold(model, ConditionKind::kTranslation, 0);
  hold(model, ConditionKind::kTranslation, 1);
  for (int k = 0; k < 3; ++k) hold(model, ConditionKind::kRotation, k);
  EquilibriumSolver solver(model);
  const PoseResult pose = solver.solve();
  EXPECT_EQ(pose.status, PoseStatus::kSingular);
  EXPECT_NE(pose.reason.find("along a line without ends"), std::string::npos) << pose.reason;
}

// A ball of radius 10 held against a hollow of radius 8: it would touch at the hollow's bottom only
// by passing through its walls.
TEST(LineContact, AContactHeldWhereTheSurfacesInterpenetrateBesideIt) {
  Model model = roller(0);
  model.pairs[0].name = "cup";
  model.pairs[0].mode = ContactMode::kClosed;
  model.pairs[0].on_B = make_sphere({0, 0, 8}, 8, false);
  model.pairs[0].on_A = make_sphere({0, 0, 0}, 10, true);
  hold(model, ConditionKind::kTranslation, 0);
  hold(model, ConditionKind::kTranslation, 1);
  for (int k = 0; k < 3; ++k) hold(model, ConditionKind::kRotation, k);
  EquilibriumSolver solver(model);
  const PoseResult pose = solver.solve();
  EXPECT_EQ(pose.status, PoseStatus::kOverlap);
  EXPECT_EQ(pose.reason, "contact \"cup\": the surfaces interpenetrate beside the point");
}

}  // namespace
}  // namespace condyle
