/// Random ends about random surfaces: a path is right, or its outcome has a name.

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "condyle/wrapping/touching_line.h"
#include "support/random.h"
#include "support/string_over.h"

namespace condyle {
namespace {

using Eigen::Vector3d;
using test::Random;
using test::StringOver;

WrapShape random_shape(Random& random, int kind) {
  if (kind == 0) {
    return WrapEllipsoid{{random.between(5, 40), random.between(5, 40), random.between(5, 40)}};
  }
  if (kind == 1) {
    const double tube = random.between(4, 10);
    return WrapTorus{random.between(1.2 * tube, 40), tube};
  }
  if (kind == 2) return WrapCylinder{random.between(3, 30)};
  return WrapSphere{random.between(3, 30)};
}

Vector3d outside(Random& random, const WrapShape& shape) {
  for (;;) {
    const Vector3d x = random.vector(60);
    if (signed_distance(shape, x) > 0.1) return x;
  }
}

double lowest_of_many(const WrapShape& shape, const Vector3d& U, const Vector3d& V) {
  constexpr int kMany = 20000;
  double lowest = INFINITY;
  for (int k = 0; k <= kMany; ++k)
    lowest = std::min(lowest, signed_distance(shape, U + k * (V - U) / kMany));
  return lowest;
}

// A line that is long beside the ring it passes goes over two of its sides.
TEST(WrappedPathRobustness, ALineIsAsHighOverARingAsItsLowestPoint) {
  const WrapShape thin = WrapTorus{8, 1};
  const Vector3d U(24.8, 44.838, -7.275), V(-39.538, -55.129, 9.077);
  EXPECT_NEAR(clearance(thin, U, V), -0.256, 1e-3);
  Random random(5);
  for (int trial = 0; trial < 300; ++trial) {
    const WrapShape ring = WrapTorus{random.between(5, 40), random.between(0.5, 4)};
    const Vector3d from = random.vector(80), to = random.vector(80);
    const double exact = lowest_of_many(ring, from, to), step = (to - from).norm() / 20000;
    const double told = clearance(ring, from, to);
    EXPECT_LE(told, exact + 1e-12) << trial;
    EXPECT_GE(told, exact - step) << trial;
  }
}

/// Error of the direction at P and Q, and how deep the path lies inside.
void expect_right(const WrapShape& shape,
                  StringOver& string,
                  const Vector3d& X,
                  const Vector3d& Y) {
  const double L = string.length(X, Y);
  EXPECT_GE(L, (Y - X).norm() - 1e-9);
  const auto touches = string.touches(X, Y);
  const LineTouch& touch = touches.at(0);
  std::vector<Vector3d> points = {X};
  string.path()->add_points({X, Y, Y}, {}, string.kept(), touches, points);
  points.push_back(Y);
  double depth = 0;
  for (const Vector3d& x : points) depth = std::min(depth, signed_distance(shape, x));
  const Vector3d U = touch.touching ? touch.P : Y, V = touch.touching ? touch.Q : X;
  for (int k = 0; k <= 50; ++k) {
    depth = std::min(depth, signed_distance(shape, X + k / 50.0 * (U - X)));
    depth = std::min(depth, signed_distance(shape, V + k / 50.0 * (Y - V)));
  }
  EXPECT_GT(depth, -1e-9);
  if (!touch.touching) return;
  EXPECT_GE(touch.arc, -1e-9);
  EXPECT_LT(((touch.P - X).normalized() - touch.t_P).norm(), 1e-10);
  EXPECT_LT(((Y - touch.Q).normalized() - touch.t_Q).norm(), 1e-10);
  EXPECT_NEAR(L, (touch.P - X).norm() + touch.arc + (Y - touch.Q).norm(), 1e-10);
}

void count_outcomes(int kind, int tries, int& found, int& wrapped) {
  Random random(static_cast<unsigned>(41 + kind));
  found = wrapped = 0;
  for (int k = 0; k < tries && !testing::Test::HasFailure(); ++k) {
    SCOPED_TRACE(k);
    const WrapShape shape = random_shape(random, kind);
    StringOver string({shape});
    const Vector3d X = outside(random, shape), Y = outside(random, shape);
    const double L = string.length(X, Y);
    const auto finding = string.finding(X, Y);
    if (finding.outcome != WrappedPath::Outcome::kFound) {
      EXPECT_EQ(finding.wrap, 0);
      continue;
    }
    EXPECT_GT(L, 0);
    ++found;
    if (string.touches(X, Y)[0].touching) ++wrapped;
    expect_right(shape, string, X, Y);
  }
}

TEST(WrappedPathRobustness, AnyTwoPointsAboutAnEllipsoid) {
  int found, wrapped;
  count_outcomes(0, 4000, found, wrapped);
  EXPECT_GT(found, 3960);
  EXPECT_GT(wrapped, 700);
}
TEST(WrappedPathRobustness, AnyTwoPointsAboutATorus) {
  int found, wrapped;
  count_outcomes(1, 3000, found, wrapped);
  EXPECT_GT(found, 2000);
  EXPECT_GT(wrapped, 300);
}
TEST(WrappedPathRobustness, AnyTwoPointsAboutACylinderOrASphere) {
  int found, wrapped;
  count_outcomes(2, 2000, found, wrapped);
  EXPECT_EQ(found, 2000);
  count_outcomes(3, 1000, found, wrapped);
  EXPECT_EQ(found, 1000);
}

// Out along a random motion and back: the same lengths, where the way is so short that no other side
// comes nearer.
TEST(WrappedPathRobustness, ThereAndBackItIsTheSamePath) {
  Random random(51);
  int wrapped = 0;
  for (int k = 0; k < 400; ++k) {
    SCOPED_TRACE(k);
    const WrapShape shape = random_shape(random, k % 4);
    StringOver string({shape});
    const Vector3d X = outside(random, shape), Y = outside(random, shape), d = random.vector(8);
    const auto at = [&](int i) {
      const Vector3d there = Y + i / 20.0 * d;
      (void)string.length(X, there);
      string.revise(X, there);
      return string.length(X, there);
    };
    std::vector<double> lengths;
    bool good = true;
    for (int i = 0; i <= 20; ++i) {
      lengths.push_back(at(i));
      const Vector3d there = Y + i / 20.0 * d;
      good = good && string.finding(X, there).outcome == WrappedPath::Outcome::kFound &&
             string.finding(X, there).conjugate > 0.02 && signed_distance(shape, there) > 0.1;
    }
    if (!good) continue;
    if (string.touches(X, Y + d)[0].touching) ++wrapped;
    for (int i = 20; i >= 0; --i) EXPECT_NEAR(at(i), lengths[static_cast<std::size_t>(i)], 1e-9);
  }
  EXPECT_GT(wrapped, 40);
}

}  // namespace
}  // namespace condyle
