#include "condyle/elements/line_element.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <vector>

#include "support/allocation_count.h"
#include "support/numerical_jacobian.h"
#include "support/random.h"

namespace condyle {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using test::Random;

Wrench wrench_of(const LineElement& element, const RigidTransform& X) {
  Wrench wrench;
  add_line_element(element, X, wrench);
  return wrench;
}

double relative_difference(const Matrix3d& found, const Matrix3d& expected) {
  return (found - expected).norm() / (1 + expected.norm());
}

void expect_exact_derivatives(const LineElement& element, const RigidTransform& X) {
  const auto force = [&](const RigidTransform& at) { return wrench_of(element, at).f; };
  const auto moment = [&](const RigidTransform& at) { return wrench_of(element, at).m; };
  const Wrench w = wrench_of(element, X);
  EXPECT_LT(relative_difference(w.F1, test::jacobian_of_translation(force, X)), 1e-9);
  EXPECT_LT(relative_difference(w.F2, test::jacobian_of_rotation(force, X)), 1e-9);
  EXPECT_LT(relative_difference(w.M1, test::jacobian_of_translation(moment, X)), 1e-9);
  EXPECT_LT(relative_difference(w.M2, test::jacobian_of_rotation(moment, X)), 1e-9);
}

TEST(LineElement, PullsTheMovingBodyTowardsItsFixedEnd) {
  // D at (0, 0, 30 + 3), C at the origin: strain 0.1, 140 N downwards, arm (0, 0, -7) from O_A: no
  // moment.
  const LineElement element{Vector3d::Zero(), Vector3d(0, 0, -7), ToeLinearLaw{2000, 0.06, 30}};
  Wrench wrench;
  const LineElementState state =
      add_line_element(element, {Matrix3d::Identity(), Vector3d(0, 0, 40)}, wrench);
  EXPECT_NEAR(state.length, 33, 1e-13);
  EXPECT_NEAR(state.force, 140, 1e-11);
  EXPECT_LT((wrench.f - Vector3d(0, 0, -140)).norm(), 1e-11);
  EXPECT_LT(wrench.m.norm(), 1e-10);
}

TEST(LineElement, MomentIsAboutTheOriginOfTheMovingBody) {
  // Force (0, 0, -f) at the arm (5, 0, 0): moment (0, 5 f, 0).
  const LineElement element{Vector3d(5, 0, 0), Vector3d(5, 0, 0), QuadraticLaw{10, 20}};
  const Wrench wrench = wrench_of(element, {Matrix3d::Identity(), Vector3d(0, 0, 22)});
  EXPECT_LT((wrench.f - Vector3d(0, 0, -40)).norm(), 1e-12);
  EXPECT_LT((wrench.m - Vector3d(0, 200, 0)).norm(), 1e-11);
}

TEST(LineElement, DerivativesAreExactForEveryLaw) {
  Random random(11);
  // The lengths below lie between 20 and 90: slack, toe, linear; the table inside and outside its
  // range.
  const std::vector<ForceLaw> laws = {
      ToeLinearLaw{5000, 0.06, 12},
      ToeLinearLaw{5000, 3.0, 15},
      QuadraticLaw{15, 10},
      PolynomialLaw{{1, 1, 2}, false},
      make_table_law({10, 40, 70}, {1, 50, 60}),
      CustomLaw{[](double L) {
        return Tension{std::sin(L / 8), std::cos(L / 8) / 8, -8 * std::cos(L / 8)};
      }}};
  for (const ForceLaw& law : laws) {
    for (int i = 0; i < 20; ++i) {
      const LineElement element{random.vector(20), random.vector(30), law};
      const RigidTransform X = random.pose(20);
      if (line_element_state(element, X).length < 20) continue;
      expect_exact_derivatives(element, X);
    }
  }
}

TEST(LineElement, BlocksOfSeveralElementsAddUp) {
  Random random(12);
  const RigidTransform X = random.pose(10);
  const LineElement one{random.vector(50), random.vector(50), QuadraticLaw{2, 1}};
  const LineElement two{random.vector(50), random.vector(50), ToeLinearLaw{900, 0.06, 3}};
  Wrench both;
  add_line_element(one, X, both);
  add_line_element(two, X, both);
  EXPECT_LT((both.M2 - wrench_of(one, X).M2 - wrench_of(two, X).M2).norm(), 1e-12 * both.M2.norm());
  EXPECT_LT((both.F2 - wrench_of(one, X).F2 - wrench_of(two, X).F2).norm(), 1e-12 * both.F2.norm());
}

TEST(LineElement, WrenchIsTheNegativeGradientOfItsEnergy) {
  Random random(13);
  const LineElement element{random.vector(30), random.vector(30), ToeLinearLaw{3000, 0.06, 5}};
  const RigidTransform X = random.pose(20);
  const Wrench w = wrench_of(element, X);
  using Row = Eigen::Matrix<double, 1, 1>;
  const auto energy = [&](const RigidTransform& at) {
    return Row(line_element_state(element, at).energy);
  };
  const Vector3d by_a = test::jacobian_at_zero<1, 3>([&](const Vector3d& da) -> Row {
                          return energy(test::displaced(X, da, Vector3d::Zero()));
                        }).transpose();
  const Vector3d by_pi = test::jacobian_at_zero<1, 3>([&](const Vector3d& dpi) -> Row {
                           return energy(test::displaced(X, Vector3d::Zero(), dpi));
                         }).transpose();
  EXPECT_LT((w.f + by_a).norm(), 1e-8 * w.f.norm());
  EXPECT_LT((w.m + by_pi).norm(), 1e-8 * w.m.norm());
}

TEST(LineElement, TurningEverythingTurnsTheWrenchAndItsDerivatives) {
  Random random(14);
  const RigidTransform X = random.pose(20), G = random.pose(100);
  const LineElement element{random.vector(30), random.vector(30), ToeLinearLaw{3000, 0.06, 5}};
  LineElement turned = element;
  turned.x_C = G * element.x_C;
  const Wrench w = wrench_of(element, X), t = wrench_of(turned, G * X);
  EXPECT_LT((t.f - G.R * w.f).norm(), 1e-11 * w.f.norm());
  EXPECT_LT((t.m - G.R * w.m).norm(), 1e-11 * w.m.norm());
  EXPECT_LT((t.M2 - G.R * w.M2 * G.R.transpose()).norm(), 1e-11 * w.M2.norm());
}

TEST(LineElement, SlackElementAddsNothing) {
  const LineElement element{Vector3d::Zero(), Vector3d(1, 2, 3), ToeLinearLaw{3000, 0.06, 500}};
  const Wrench w = wrench_of(element, {Matrix3d::Identity(), Vector3d(10, 0, 0)});
  EXPECT_EQ(w.f, Vector3d::Zero());
  EXPECT_EQ(w.M2, Matrix3d::Zero());
}

TEST(LineElement, ElementOfNoLengthSaysSoByItsLengthAndAddsNothing) {
  // f(0) = 1 would pull, but in no direction.
  const LineElement element{Vector3d(1, 2, 3), Vector3d(1, 2, 3), PolynomialLaw{{1, 1}, false}};
  Wrench wrench;
  const LineElementState state = add_line_element(element, {}, wrench);
  EXPECT_LT(state.length, kLeastLength);
  EXPECT_EQ(wrench.f, Vector3d::Zero());
  EXPECT_EQ(wrench.F1, Matrix3d::Zero());
}

TEST(LineElement, AllocatesNothing) {
  const LineElement element{Vector3d(40, 0, 0), Vector3d(1, 2, 3), ToeLinearLaw{3000, 0.06, 5}};
  Wrench wrench;
  const test::AllocationCount count;
  add_line_element(element, {}, wrench);
  EXPECT_EQ(count.since_start(), 0);
  EXPECT_GT(wrench.f.norm(), 0);
}

}  // namespace
}  // namespace condyle
