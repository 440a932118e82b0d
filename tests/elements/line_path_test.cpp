#include "condyle/elements/line_path.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <limits>
#include <memory>

#include "condyle/elements/line_element.h"
#include "condyle/elements/line_element_block.h"
#include "support/led_paths.h"
#include "support/numerical_jacobian.h"
#include "support/random.h"

namespace condyle {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using test::Random;

double difference(const Matrix3d& found, const Matrix3d& expected) {
  return (found - expected).norm() / (1 + expected.norm());
}

double difference(const Wrench& found, const Wrench& expected) {
  return std::max({(found.f - expected.f).norm() / (1 + expected.f.norm()),
                   (found.m - expected.m).norm() / (1 + expected.m.norm()),
                   difference(found.F1, expected.F1), difference(found.F2, expected.F2),
                   difference(found.M1, expected.M1), difference(found.M2, expected.M2)});
}

template <class WrenchAt>
void expect_exact_derivatives(const WrenchAt& wrench_at, const RigidTransform& X) {
  const auto force = [&](const RigidTransform& at) { return wrench_at(at).f; };
  const auto moment = [&](const RigidTransform& at) { return wrench_at(at).m; };
  const Wrench w = wrench_at(X);
  EXPECT_LT(difference(w.F1, test::jacobian_of_translation(force, X)), 1e-9);
  EXPECT_LT(difference(w.F2, test::jacobian_of_rotation(force, X)), 1e-9);
  EXPECT_LT(difference(w.M1, test::jacobian_of_translation(moment, X)), 1e-9);
  EXPECT_LT(difference(w.M2, test::jacobian_of_rotation(moment, X)), 1e-9);
}

// H = (I - e eᵀ)/L: told at either end, a straight line is a path too.
TEST(LinePath, AStraightLineIsOneAtEitherEnd) {
  Random random(31);
  for (int k = 0; k < 20; ++k) {
    const LineElement element{random.vector(30), random.vector(20), ToeLinearLaw{3000, 0.06, 5}};
    LineElement unit = element;
    unit.law = CustomLaw{[](double L) { return Tension{1, 0, L}; }};
    const RigidTransform X = random.pose(20);
    const LineEnds ends = ends_of(element, X);
    const double L = (ends.x_D - ends.x_C).norm();
    const Vector3d e = (ends.x_D - ends.x_C) / L;
    const Matrix3d H = (Matrix3d::Identity() - e * e.transpose()) / L;
    Wrench expected;
    add_line_element(unit, X, expected);
    EXPECT_LT(difference(pull_at_moving_end(e, H, ends.q), expected), 1e-12);
    EXPECT_LT(difference(pull_at_fixed_end(e, H, ends.x_C - X.p), expected), 1e-12);
  }
}

TEST(LinePath, OverAnEdgeHasTheClosedFormsOfTwoPieces) {
  // From (-30, 0, 0) over (0, 0, 40) to (30, 0, 0): twice 50. Pulled with 10 N/mm x 20 mm = 200 N
  // towards the edge.
  const auto path =
      std::make_shared<test::EdgePath>(Vector3d(0, 0, 40), Vector3d(0, 1, 0), Vector3d(0, 0, 1));
  const LineElement element{Vector3d(-30, 0, 0), Vector3d(5, 0, 0), CustomLaw{[](double L) {
                              return Tension{10 * (L - 80), 10, 5 * (L - 80) * (L - 80)};
                            }},
                            path};
  Wrench wrench;
  const RigidTransform X{Matrix3d::Identity(), {25, 0, 0}};
  const LineElementState state = add_line_element(element, X, wrench);
  EXPECT_NEAR(state.length, 100, 1e-12);
  EXPECT_NEAR(state.force, 200, 1e-11);
  EXPECT_NEAR(state.energy, 2000, 1e-9);
  EXPECT_LT((wrench.f - Vector3d(-120, 0, 160)).norm(), 1e-11);
  EXPECT_LT((wrench.m - Vector3d(0, -800, 0)).norm(), 1e-10);
  EXPECT_NEAR(line_element_state(element, X).length, 100, 1e-12);
}

std::shared_ptr<const LinePath> random_edge(Random& random) {
  const Vector3d along = random.direction();
  return std::make_shared<test::EdgePath>(random.vector(20), along, along.unitOrthogonal());
}

TEST(LinePath, DerivativesAreExactOnBothSidesOfAnEdge) {
  Random random(32);
  int over = 0;
  for (int k = 0; k < 40; ++k) {
    const LineElement element{random.vector(60), random.vector(30), ToeLinearLaw{3000, 0.06, 5},
                              random_edge(random)};
    const RigidTransform X = random.pose(20);
    double kept = NAN;
    Wrench first;
    const LineElementState state = add_line_element(element, X, first, &kept);
    if (state.length < 20) continue;
    over += kept == 1 ? 1 : 0;
    expect_exact_derivatives(
        [&](const RigidTransform& at) {
          Wrench wrench;
          add_line_element(element, at, wrench, &kept);
          return wrench;
        },
        X);
  }
  EXPECT_GT(over, 5);
  EXPECT_LT(over, 35);
}

/// Length of a path that goes through a point of A, from x_C on B to x_D on A.
class ThroughA : public LinePath {
 public:
  explicit ThroughA(const Vector3d& point) : point_(point) {}
  double pull(const LineEnds& ends,
              const RigidTransform& X_BA,
              double*,
              Wrench& unit) const override {
    const Vector3d P = X_BA * point_;
    const double l = (P - ends.x_C).norm();
    const Vector3d e = (P - ends.x_C) / l;
    unit = pull_at_fixed_end(e, (Matrix3d::Identity() - e * e.transpose()) / l, ends.x_C - X_BA.p);
    return l + (ends.x_D - P).norm();
  }

 private:
  Vector3d point_;
};

// What leads the path on A pulls there as the element that ends there.
TEST(LinePath, LedByTheMovingBodyItHasExactDerivativesToo) {
  Random random(33);
  for (int k = 0; k < 10; ++k) {
    const Vector3d P = random.vector(30);
    const LineElement element{random.vector(60), random.vector(30), ToeLinearLaw{3000, 0.06, 5},
                              std::make_shared<ThroughA>(P)};
    const RigidTransform X = random.pose(20);
    const auto wrench_at = [&](const RigidTransform& at) {
      Wrench wrench;
      add_line_element(element, at, wrench);
      return wrench;
    };
    expect_exact_derivatives(wrench_at, X);
  }
}

TEST(LinePath, ABlockOfStraightAndOtherElementsIsTheirSum) {
  Random random(34);
  std::vector<LineElement> elements;
  for (int k = 0; k < 7; ++k) {
    elements.push_back({random.vector(60), random.vector(30), ToeLinearLaw{3000, 0.06, 5}});
    if (k % 3 == 1) elements.back().path = random_edge(random);
  }
  const RigidTransform X = random.pose(20);
  Wrench expected, found;
  double magnitudes = 0;
  for (const LineElement& element : elements)
    magnitudes += add_line_element(element, X, expected).force;
  LineElementBlock block(elements);
  EXPECT_TRUE(block.has_paths());
  const LineElementBlock::Summary summary = block.add_to(X, {}, found);
  EXPECT_LT(difference(found, expected), 1e-12);
  EXPECT_NEAR(summary.force_magnitudes, magnitudes, 1e-12 * magnitudes);
  EXPECT_EQ(summary.zero_element, -1);
  EXPECT_EQ(block.paths().size(), 2U);
  // The status that is given is held, though another would be chosen.
  std::vector<double> held = block.paths();
  for (double& number : held) number = 1 - number;
  Wrench other;
  (void)block.add_to(X, held, other);
  EXPECT_EQ(block.paths(), held);
  EXPECT_GT(difference(other, expected), 1e-3);
  EXPECT_TRUE(block.revise_paths(X));
  EXPECT_FALSE(block.revise_paths(X));
  // A straight element of no length is named by its number among all.
  elements[5].x_C = X * elements[5].s_D;
  block.set(elements);
  EXPECT_EQ(block.add_to(X, {}, found).zero_element, 5);
}

}  // namespace
}  // namespace condyle
