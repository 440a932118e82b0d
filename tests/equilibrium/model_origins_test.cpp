/// The points that a model is computed about, and its length, come from what acts on its bodies.

#include <gtest/gtest.h>

#include "condyle/equilibrium/equilibrium_solver.h"
#include "condyle/equilibrium/model_origins.h"
#include "condyle/math/degree.h"
#include "support/ball_on_floor.h"
#include "support/hold.h"
#include "support/quadric_knee.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

const BodyOrigins kFar{{-1700, 900, 2300}, {800, -2600, 1100}};

TEST(ModelOrigins, LengthIsThatOfWhatActsWhereverTheFramesHaveTheirOrigins) {
  Model knee = test::quadric_knee();
  const double length = characteristic_length(knee);
  EXPECT_GT(length, 20);
  EXPECT_LT(length, 60);
  move_origins(kFar, knee);
  EXPECT_NEAR(characteristic_length(knee), length, 1e-10);
  move_origins(middle_of_forces(knee), knee);
  EXPECT_NEAR(characteristic_length(knee), length, 1e-10);
  const BodyOrigins left = middle_of_forces(knee);
  EXPECT_LT(left.A.norm() + left.B.norm(), 1e-10);
}

TEST(ModelOrigins, ABallOnAPlaneIsMeasuredByItsRadius) {
  Model model = test::ball_on_floor("weight", -10);
  EXPECT_DOUBLE_EQ(characteristic_length(model), 10);
  model.pairs[0].on_A = make_sphere({3000, -200, 40}, 10, true);
  EXPECT_DOUBLE_EQ(characteristic_length(model), 10);
}

TEST(ModelOrigins, APairIsNoLargerThanItsSmallerSurface) {
  Model model = test::ball_on_floor("weight", -10);
  model.pairs[0].on_B = make_sphere({0, 0, 0}, 10, true);
  model.pairs[0].on_A = make_sphere({0, 0, 1e6}, 1e6, true);
  EXPECT_DOUBLE_EQ(characteristic_length(model), 10);
}

// One point alone has no lever: the lines that hold it have a length.
TEST(ModelOrigins, LinesThatMeetInOnePointAreMeasuredByTheirLength) {
  Model model;
  for (const double x : {-30.0, 30.0}) {
    model.elements.push_back({{x, 0, 0}, {500, 0, 900}, PolynomialLaw{{0.0, 1.0}, false}});
    model.element_names.emplace_back("line");
  }
  model.start.p = Vector3d(0, 0, 40) - Vector3d(500, 0, 900);
  EXPECT_NEAR(characteristic_length(model), 50, 1e-9);
}

TEST(ModelOrigins, HaveNoSayInWhatIsTold) {
  EquilibriumSolver plain(test::quadric_knee());
  Model model = test::quadric_knee();
  const BodyOrigins near = {{4, -7, 3}, {-5, 6, 11}};
  move_origins(near, model);
  EquilibriumSolver moved(std::move(model));
  for (int flexion = 0; flexion <= 90; flexion += 30) {
    const Drive drive = condition_value(0).with(drive_of(plain.model()), flexion * kDegree);
    const PoseResult a = plain.solve(drive), b = moved.solve(drive);
    ASSERT_TRUE(a.converged() && b.converged());
    EXPECT_LT((a.X_BA.p - b.X_BA.p).norm(), 1e-9);
    EXPECT_LT((a.X_BA.R - b.X_BA.R).norm(), 1e-11);
    for (std::size_t c = 0; c < a.contacts.size(); ++c) {
      EXPECT_NEAR(a.contacts[c].force, b.contacts[c].force, 1e-8);
      EXPECT_LT((a.contacts[c].resultant_ground - b.contacts[c].resultant_ground).norm(), 1e-9);
      EXPECT_LT(
          (a.contacts[c].points[0].point_moving - b.contacts[c].points[0].point_moving).norm(),
          1e-9);
    }
  }
}

// A ball that is held off the floor by O_A, a point of its rim, along a slanting axis.
TEST(ModelOrigins, APrescribedTranslationStaysThatOfTheFilesOrigin) {
  Model model = test::ball_on_floor("weight", -10);
  model.pairs[0].on_A = make_sphere({0, 10, 0}, 10, true);
  model.loads[0].at = {0, 10, 0};
  model.start.p = {0, 0, 10};
  test::hold(model, ConditionKind::kTranslation, 0, 2);
  test::add(model, "hold", test::held(ConditionKind::kTranslation, Vector3d(0, 0.6, 0.8), 0, 11));
  for (int k = 0; k < 3; ++k) test::hold(model, ConditionKind::kRotation, k, 0.1 * k);
  Model moved = model;
  move_origins(kFar, moved);
  moved.length = model.length;
  const PoseResult a = EquilibriumSolver(std::move(model)).solve();
  const PoseResult b = EquilibriumSolver(std::move(moved)).solve();
  ASSERT_TRUE(a.converged()) << a.reason;
  ASSERT_TRUE(b.converged()) << b.reason;
  EXPECT_NEAR(a.X_BA.p.x(), 2, 1e-10);
  EXPECT_NEAR(Vector3d(0, 0.6, 0.8).dot(b.X_BA.p), 11, 1e-10);
  EXPECT_LT((a.X_BA.p - b.X_BA.p).norm(), 1e-9);
  for (std::size_t k = 0; k < a.conditions.size(); ++k)
    EXPECT_NEAR(a.conditions[k].multiplier, b.conditions[k].multiplier, 1e-7);
}

}  // namespace
}  // namespace condyle
