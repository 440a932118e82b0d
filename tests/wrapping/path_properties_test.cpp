/// What holds of every shortest path, and figures of checks.json that a fresh clone tests too.

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "condyle/math/rotation.h"
#include "support/allocation_count.h"
#include "support/random.h"
#include "support/string_over.h"

namespace condyle {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using test::Random;
using test::StringOver;

const WrapEllipsoid kEllipsoid{{30, 18, 12}};
const Vector3d kX(-24, 20, 3), kY(22, -6, 15);

// shared/published/wrapping/checks.json: found in two independent ways to 12 digits.
TEST(WrappedPath, HasThePublishedLengths) {
  StringOver sphere({WrapSphere{20}}), cylinder({WrapCylinder{18}}), ellipsoid({kEllipsoid}),
      torus({WrapTorus{30, 8}}), through({WrapTorus{30, 8}}, {Vector3d(22, 0, 0)}),
      around({WrapEllipsoid{{25, 40, 15}}}, {Vector3d(0, 0, 15)});
  EXPECT_NEAR(sphere.length({-35, 5, 8}, {30, -12, 6}), 71.67997591281, 1e-10);
  EXPECT_NEAR(cylinder.length({-25, 4, -10}, {22, 9, 25}), 63.66629981375, 1e-10);
  EXPECT_NEAR(torus.length({20, -25, 11}, {40, 20, 3}), 49.98227870057, 1e-10);
  EXPECT_NEAR(through.length({33, -7, 13}, {31, 6, -14}), 37.00453264661, 1e-10);
  EXPECT_NEAR(ellipsoid.length(kX, kY), 54.34474617886, 1e-10);
  EXPECT_NEAR(around.length({-30, 5, -2}, {28, -8, -6}), 75.57562669680, 1e-10);
  EXPECT_NEAR(around.touches({-30, 5, -2}, {28, -8, -6})[0].arc, 52.5269038039697, 1e-9);
  EXPECT_NEAR(ellipsoid.finding(kX, kY).conjugate, 51.06944190407 / 54.34474617886, 1e-11);
  const test::StringEnds ends = ellipsoid.ends(kX, kY);
  EXPECT_LT((ends.e_X - Vector3d(0.8421042692032, -0.4464349106696, 0.3025826669277)).norm(),
            1e-11);
  EXPECT_NEAR(ends.H_XX(2, 2), 0.03917863867675, 1e-11);
  EXPECT_NEAR(ends.H_YY(0, 1), 0.007437213355999, 1e-11);
}

// S11: L, its slope and the path go over into the straight line, and the second derivative jumps.
TEST(WrappedPath, LiftsOffACylinderSmoothly) {
  StringOver string({WrapCylinder{10}});
  const auto at = [&](double h) { return string.ends({-40, h, 0}, {40, h, 0}); };
  struct Height {
    double h, L, slope;
  };
  for (const Height& row : {Height{9, 80.02504838951451, -0.05014144397706},
                            Height{9.9, 80.0002500517168, -0.005001547835291},
                            Height{9.99, 80.00000250005205, -0.00050001561035}}) {
    const test::StringEnds ends = at(row.h);
    EXPECT_NEAR(ends.length, row.L, 1e-12);
    EXPECT_NEAR(ends.e_Y.y() - ends.e_X.y(), row.slope, 1e-12);
  }
  // Held, the path goes on smoothly where it would have to pull; revised, it leaves.
  const test::StringEnds held = at(10.001);
  EXPECT_NEAR(held.length, 80 + 1e-6 / 40, 1e-9);
  EXPECT_LT(string.touches({-40, 10.001, 0}, {40, 10.001, 0})[0].arc, 0);
  EXPECT_TRUE(string.revise({-40, 10.001, 0}, {40, 10.001, 0}));
  EXPECT_FALSE(string.revise({-40, 10.001, 0}, {40, 10.001, 0}));
  EXPECT_EQ(at(10.001).length, 80);
  // And held off, it is straight inside until it is revised.
  EXPECT_EQ(at(9.99).length, 80);
  EXPECT_TRUE(string.revise({-40, 9.99, 0}, {40, 9.99, 0}));
  EXPECT_FALSE(string.revise({-40, 9.99, 0}, {40, 9.99, 0}));
  EXPECT_NEAR(at(9.99).length, 80.00000250005205, 1e-12);
}

/// Over a circle of radius r about the origin, on the far side of it from the ends (±x, y), y < 0.
double round_the_far_side(double r, double x, double y) {
  const double far = std::hypot(x, y), turn = M_PI - 2 * std::atan2(y, x) - 2 * std::acos(r / far);
  return 2 * std::sqrt(far * far - r * r) + r * turn;
}

// A pose may lie so far from the last one that the straight line has gone through a cylinder, or through the
// tube of a ring: the string has not. Closed forms in the plane.
TEST(WrappedPath, IsNotDrawnThroughASurface) {
  StringOver post({WrapCylinder{10}});
  EXPECT_EQ(post.length({-40, 12, 0}, {40, 12, 0}), 80);
  EXPECT_FALSE(post.revise({-40, 12, 0}, {40, 12, 0}));
  EXPECT_EQ(post.length({-40, -12, 0}, {40, -12, 0}), 80);  // held
  EXPECT_TRUE(post.revise({-40, -12, 0}, {40, -12, 0}));
  EXPECT_NEAR(post.length({-40, -12, 0}, {40, -12, 0}), round_the_far_side(10, 40, -12), 1e-10);
  EXPECT_FALSE(post.revise({-40, -12, 0}, {40, -12, 0}));

  StringOver ring({WrapTorus{30, 8}});
  EXPECT_EQ(ring.length({0, 0, -40}, {0, 0, 40}), 80);
  EXPECT_EQ(ring.length({50, 0, -40}, {50, 0, 40}), 80);
  EXPECT_TRUE(ring.revise({50, 0, -40}, {50, 0, 40}));
  EXPECT_NEAR(ring.length({50, 0, -40}, {50, 0, 40}), round_the_far_side(8, 40, -20), 1e-10);
  EXPECT_GT(ring.finding({50, 0, -40}, {50, 0, 40}).conjugate, 0);
}

// From one side of the hole of a ring to the other, mirrored, in one step.
TEST(WrappedPath, StaysInTheRingThroughWhichItGoes) {
  for (const double x : {6.0, 12.0, 33.0}) {
    StringOver ring({WrapTorus{30, 8}}, {Vector3d(22, 0, 0)});
    EXPECT_NEAR(ring.length({33, -7, 13}, {31, 6, -14}), 37.00453264661, 1e-10);
    StringOver there({WrapTorus{30, 8}}, {Vector3d(-22, 0, 0)});
    const Vector3d X(-x, -7, 13), Y(2 - x, 6, -14);
    double expected = there.length(X, Y);
    for (int k = 0; k < 3 && there.revise(X, Y); ++k) expected = there.length(X, Y);
    (void)ring.length(X, Y);
    for (int k = 0; k < 3 && ring.revise(X, Y); ++k) (void)ring.length(X, Y);
    EXPECT_NEAR(ring.length(X, Y), expected, 1e-9) << x;
    EXPECT_EQ(ring.finding(X, Y).outcome, WrappedPath::Outcome::kFound);
  }
}

// Off a sphere it slips; about the end of what it passes it may go.
TEST(WrappedPath, IsStraightWhereItSlipsOffOrGoesAround) {
  StringOver ball({WrapSphere{10}});
  EXPECT_EQ(ball.length({-40, 12, 0}, {40, 12, 0}), 80);
  EXPECT_FALSE(ball.revise({-40, -12, 1}, {40, -12, 1}));
  EXPECT_EQ(ball.length({-40, -12, 1}, {40, -12, 1}), 80);

  StringOver post({WrapCylinder{10}});
  const double L = std::hypot(20, 30);
  EXPECT_EQ(post.length({-40, 0, 0}, {-20, 30, 0}), L);
  EXPECT_FALSE(post.revise({-40, 0, 0}, {-20, -30, 0}));
  EXPECT_EQ(post.length({-40, 0, 0}, {-20, -30, 0}), L);
}

// As a run is taken up again: what was told of a path says where it passed.
TEST(WrappedPath, TakenUpAgainItIsNotDrawnThroughASurfaceEither) {
  StringOver post({WrapCylinder{10}}), again({WrapCylinder{10}});
  const Vector3d X(-40, 12, 0), Y(40, 12, 0);
  (void)post.length(X, Y);
  again.path()->keep(post.touches(X, Y), {X, Y, Y}, {}, again.kept());
  EXPECT_TRUE(again.revise({-40, -12, 0}, {40, -12, 0}));
  EXPECT_NEAR(again.length({-40, -12, 0}, {40, -12, 0}), round_the_far_side(10, 40, -12), 1e-10);
}

TEST(WrappedPath, TurnedMovedAndMirroredItIsTheSame) {
  Random random(11);
  StringOver string({kEllipsoid});
  const double L = string.length(kX, kY);
  const test::StringEnds ends = string.ends(kX, kY);
  for (int k = 0; k < 10; ++k) {
    const RigidTransform X = random.pose(100);
    StringOver moved({kEllipsoid}, {}, {X});
    EXPECT_NEAR(moved.length(X * kX, X * kY), L, 1e-12);
    const test::StringEnds there = moved.ends(X * kX, X * kY);
    EXPECT_LT((there.H_YY - X.R * ends.H_YY * X.R.transpose()).norm(), 1e-10);
    EXPECT_LT((there.e_Y - X.R * ends.e_Y).norm(), 1e-12);
  }
  const Vector3d mirror(-1, 1, 1);
  EXPECT_NEAR(StringOver({kEllipsoid}).length(mirror.cwiseProduct(kX), mirror.cwiseProduct(kY)), L,
              1e-12);
}

// From D to C instead: the same string, its ends exchanged.
TEST(WrappedPath, ReversedItIsTheSame) {
  const Matrix3d z_to_y = exp_rotation(Vector3d(-M_PI / 2, 0, 0));
  const RigidTransform there{z_to_y, {40, 0, 8}};
  const Vector3d X(-34, 10, -20), Y(60, 8, 5), side(40, 0, 17);
  StringOver forth({kEllipsoid, WrapCylinder{9}}, {{}, side}, {{}, there});
  StringOver back({WrapCylinder{9}, kEllipsoid}, {side, {}}, {there, {}});
  EXPECT_NEAR(forth.length(X, Y), 107.96888891042, 1e-10);
  EXPECT_NEAR(back.length(Y, X), forth.length(X, Y), 1e-12);
  const test::StringEnds a = forth.ends(X, Y), b = back.ends(Y, X);
  EXPECT_LT((a.e_X + b.e_Y).norm(), 1e-12);
  EXPECT_LT((a.H_XX - b.H_YY).norm(), 1e-11);
}

// Along its own tangent an end moves without any other change.
TEST(WrappedPath, SlidingAnEndAlongItsTangentTakesOffAsMuch) {
  for (const WrapShape& shape : {WrapShape(kEllipsoid), WrapShape(WrapSphere{14})}) {
    StringOver string({shape});
    const double L = string.length(kX, kY);
    const test::StringEnds ends = string.ends(kX, kY);
    EXPECT_NEAR(string.length(kX + 3 * ends.e_X, kY), L - 3, 1e-12);
    EXPECT_NEAR(string.length(kX, kY + 5 * ends.e_Y), L + 5, 1e-12);
  }
}

// Shrunk about its centre, beside the line, it lets go of the string; the blocks are a straight one's.
TEST(WrappedPath, OverASurfaceThatShrinksItBecomesStraight) {
  const Vector3d X(-30, 0, 3), Y(40, 2, -3), c(2, 1, -1.5);
  const Vector3d e = (Y - X).normalized();
  double last = 1e9;
  for (const double scale : {1.0, 0.7, 0.4, 0.1, 1e-6}) {
    StringOver string({WrapEllipsoid{scale * kEllipsoid.semi_axes}}, {},
                      {{Matrix3d::Identity(), c}});
    const test::StringEnds ends = string.ends(X, Y);
    EXPECT_LE(ends.length, last);
    last = ends.length;
    if (scale > 0.1) continue;
    EXPECT_NEAR(ends.length, (Y - X).norm(), 1e-12);
    const Matrix3d straight = (Matrix3d::Identity() - e * e.transpose()) / (Y - X).norm();
    EXPECT_LT((ends.H_YY - straight).norm(), 1e-14);
    EXPECT_LT((ends.H_XX - straight).norm(), 1e-14);
  }
}

TEST(WrappedPath, ASurfaceThatSwallowsAnEndIsNamed) {
  StringOver string({kEllipsoid}, {}, {}, {true});
  EXPECT_GT(string.length({1, 2, 3}, kY), 0);
  EXPECT_EQ(string.finding({1, 2, 3}, kY).outcome, WrappedPath::Outcome::kEndInside);
  EXPECT_EQ(string.finding({1, 2, 3}, kY).wrap, 0);
}

TEST(WrappedPath, AnEndInItsOwnBonesSurfaceIsAnchoredOrPassedOver) {
  const Vector3d inside(0, 0, 11), Y(40, 0, 11.5), away(10, 0, 40);
  StringOver anchored({kEllipsoid});
  // From the top of the ellipse x²/30² + z²/12² = 1, then along it; away from it at once straight.
  EXPECT_GT(anchored.length(inside, Y), (Y - Vector3d(0, 0, 12)).norm());
  EXPECT_LT((anchored.touches(inside, Y)[0].P - Vector3d(0, 0, 12)).norm(), 1e-12);
  anchored.forget();
  EXPECT_NEAR(anchored.length(inside, away), (away - Vector3d(0, 0, 12)).norm(), 1e-12);
  StringOver passed({kEllipsoid}, {}, {}, {}, InsideRule::kStraight);
  EXPECT_NEAR(passed.length(inside, Y), (Y - inside).norm(), 1e-12);
  const auto ends = inside_ends({{"e", kEllipsoid, {}, false, {}}}, inside, Y);
  EXPECT_EQ(ends[0].wrap, 0);
  EXPECT_NEAR(ends[0].depth, 1, 1e-12);
  EXPECT_EQ(ends[1].wrap, -1);
}

/// Largest difference of the wrenches of two pulls: forces [-], moments and blocks for arms of 100 mm.
double difference(const Wrench& a, const Wrench& b) {
  constexpr double kArm = 100;
  return std::max({(a.f - b.f).norm(), (a.m - b.m).norm() / kArm, kArm * (a.F1 - b.F1).norm(),
                   (a.F2 - b.F2).norm(), (a.M1 - b.M1).norm(), (a.M2 - b.M2).norm() / kArm});
}

// Newton's last step on the path is taken to first order, whatever its size.
TEST(WrappedPath, APullDoesNotShowWhereThePathCameFrom) {
  for (const bool on_A : {false, true}) {
    const std::vector<PathWrap> wraps = {{"e", kEllipsoid, {}, on_A, {}}};
    const auto path = make_wrapped_path(wraps, kX, kY);
    auto fresh = unknown_path();
    Wrench expected, unit;
    const double L = path->pull({kX, kY, kY}, {}, fresh.data(), expected);
    Random random(7);
    for (int k = 0; k < 300; ++k) {
      const double way = std::pow(10, random.between(-5, 0.5));  // [mm]
      const Vector3d from = kY + way * random.direction();
      auto kept = unknown_path();
      ASSERT_GT(path->pull({kX, from, kY}, {Matrix3d::Identity(), from - kY}, kept.data(), unit),
                0);
      EXPECT_NEAR(path->pull({kX, kY, kY}, {}, kept.data(), unit), L, 1e-12 * L) << way;
      EXPECT_LT(difference(unit, expected), 2e-9) << way;
    }
  }
}

// Far from a solution a pull may stop a step before it is exact; the one after it has to go on from there.
TEST(WrappedPath, ARoughPullIsNearAndTheNextOneExact) {
  for (const bool on_A : {false, true}) {
    const auto path = make_wrapped_path({{"e", kEllipsoid, {}, on_A, {}}}, kX, kY);
    const auto ends = [](const Vector3d& Y) { return LineEnds{kX, Y, kY}; };
    const auto moved = [](const Vector3d& Y) {
      return RigidTransform{Matrix3d::Identity(), Y - kY};
    };
    auto fresh = unknown_path();
    Wrench expected, unit;
    const double L = path->pull(ends(kY), {}, fresh.data(), expected);
    Random random(11);
    double roughest = 0;
    for (int k = 0; k < 300; ++k) {
      const double way = std::pow(10, random.between(-5, 0.5));  // [mm]
      const Vector3d from = kY + way * random.direction(), between = kY + 0.1 * (from - kY);
      auto kept = unknown_path();
      path->pull(ends(from), moved(from), kept.data(), unit);
      path->pull_roughly(ends(between), moved(between), kept.data(), unit);
      const double rough = path->pull_roughly(ends(kY), {}, kept.data(), unit);
      EXPECT_NEAR(rough, L, 1e-6) << way;
      EXPECT_LT(difference(unit, expected), 1e-3) << way;
      roughest = std::max(roughest, (unit.f - expected.f).norm());
      EXPECT_LT((unit.f - expected.f).norm(), 1e-6) << way;
      EXPECT_NEAR(path->pull(ends(kY), {}, kept.data(), unit), L, 1e-12 * L) << way;
      EXPECT_LT(difference(unit, expected), 2e-9) << way;
    }
    EXPECT_GT(roughest, 1e-12);  // else it would be an exact one
  }
}

TEST(WrappedPath, PullLengthAndReviseAllocateNothing) {
  const RigidTransform there{exp_rotation(Vector3d(-M_PI / 2, 0, 0)), {40, 0, 8}};
  const auto path = make_wrapped_path(
      {{"e", kEllipsoid, {}, false, {}}, {"c", WrapCylinder{9}, there, true, Vector3d(40, 0, 17)}},
      {-34, 10, -20}, {60, 8, 5});
  Wrench unit;
  const test::AllocationCount count;
  auto kept = unknown_path();
  for (int k = 0; k < 10; ++k) {
    const Vector3d Y(60, 8 + 0.1 * k, 5 + k);
    EXPECT_GT(path->pull({{-34, 10, -20}, Y, Y}, {}, kept.data(), unit), 90);
    path->revise({{-34, 10, -20}, Y, Y}, {}, kept.data());
    EXPECT_GT(path->length({{-34, 10, -20}, Y, Y}, {}, kept.data()), 90);
  }
  EXPECT_EQ(count.since_start(), 0);
}

}  // namespace
}  // namespace condyle
