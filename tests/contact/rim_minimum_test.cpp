/// The edge of a known part, between samples: where it lies lowest over the other surface.

#include "condyle/contact/rim_minimum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "condyle/contact/contact_search.h"
#include "condyle/math/rotation.h"
#include "condyle/surface/exact_surfaces.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

const Vector3d kUp = Vector3d::UnitZ(), kOrigin = Vector3d::Zero();
constexpr double kRadius = 12, kReach = 3;  // of a disc, and of the search along its edge [mm]

constexpr double kAnyGap = std::numeric_limits<double>::infinity();

// A disc tilted by α over a plane: its edge is lowest where it has gone down by r sin α.
TEST(RimMinimum, OfATiltedDiscIsItsLowestPoint) {
  constexpr double kTilt = 0.2, kHeight = 3;
  const auto disc = make_plane(kOrigin, kUp, kRadius), plane = make_plane(kOrigin, -kUp, 100);
  const RigidTransform X{exp_rotation({0, kTilt, 0}), {0, 0, -kHeight}};
  const Place start{{-11 * std::cos(0.1), 11 * std::sin(0.1), 0}};
  const auto rim = rim_minimum(*disc, start, *plane, {kOrigin}, X, kReach, kAnyGap);
  ASSERT_TRUE(rim.has_value());
  EXPECT_NEAR(rim->gap, kHeight - kRadius * std::sin(kTilt), 1e-7);
  EXPECT_NEAR(disc->edge_distance(rim->on_rim), 0, 1e-8);
  EXPECT_LT((rim->on_rim.numbers - Vector3d(-kRadius, 0, 0)).norm(), 2e-3);
  const auto below = [&](double cutoff) {
    return rim_minimum(*disc, start, *plane, {kOrigin}, X, kReach, cutoff);
  };
  EXPECT_EQ(below(rim->gap + 1e-9)->gap, rim->gap);
  EXPECT_FALSE(below(rim->gap - 0.1).has_value());
}

// The same over a plane that is known within a circle which the tilted edge crosses before its lowest
// point: there it ends.
TEST(RimMinimum, EndsWhereWhatItFacesDoes) {
  constexpr double kTilt = 0.2, kHeight = 3, kKnown = 16;
  const Vector3d center(6, 4, 0);
  const auto disc = make_plane(kOrigin, kUp, kRadius), plane = make_plane(center, -kUp, kKnown);
  const RigidTransform X{exp_rotation({0, kTilt, 0}), {0, 0, -kHeight}};
  const auto on_edge = [&](double angle) {
    return Vector3d(-kRadius * std::cos(angle), kRadius * std::sin(angle), 0);
  };
  const auto beyond = [&](double angle) {
    const Vector3d d = X * on_edge(angle) - center;
    return std::hypot(d.x(), d.y()) - kKnown;
  };
  double out = 0, in = 1.5;
  ASSERT_GT(beyond(out), 0);
  ASSERT_LT(beyond(in), 0);
  for (int k = 0; k < 60; ++k) (beyond(0.5 * (out + in)) > 0 ? out : in) = 0.5 * (out + in);
  const double exact = kHeight - kRadius * std::cos(in) * std::sin(kTilt);
  for (const double aside : {-0.05, 0.0, 0.02, 0.1}) {
    const Place start{11.0 / kRadius * on_edge(in + aside)};
    const auto rim = rim_minimum(*disc, start, *plane, {center}, X, kReach, kAnyGap);
    ASSERT_TRUE(rim.has_value());
    EXPECT_GT(rim->gap, exact - 1e-9);
    EXPECT_LT(rim->gap, exact + 2e-4);
  }
}

TEST(RimMinimum, ASurfaceWithoutAnEdgeHasNone) {
  const auto ball = make_sphere(kOrigin, 20, true), plane = make_plane(kOrigin, -kUp, 100);
  EXPECT_FALSE(
      rim_minimum(*ball, {{0, 0, 20}}, *plane, {kOrigin}, {}, kReach, kAnyGap).has_value());
}

// The disc's plane would be nearest to the ball 5 mm beyond the disc's edge: no minimum of the gap
// lies on it, and its edge is in the ball by two thousandths of a millimetre.
TEST(RimMinimum, AnEdgeWithinABallIsFoundBetweenSamples) {
  constexpr double kBall = 30, kAside = 5, kOverlap = 0.002;
  ContactPair pair;
  pair.on_B = make_sphere({0, 0, -kBall}, kBall, true);
  pair.on_A = make_plane(kOrigin, -kUp, kRadius);
  const double reach = kBall - kOverlap;
  const double height = std::sqrt(reach * reach - kAside * kAside) - kBall;
  ContactSearch search(pair);
  std::vector<GapMinimum> minima;
  for (const double turn : {0.0, 0.03, 0.05, 0.07}) {  // other samples beside the lowest point
    search.find({exp_rotation({0, 0, turn}), {kRadius + kAside, 0, height}}, 0, minima);
    ASSERT_FALSE(minima.empty()) << turn;
    EXPECT_NEAR(minima.front().gap, -kOverlap, 1e-6) << turn;
    EXPECT_FALSE(minima.front().refined);
    EXPECT_NEAR(minima.front().edge, 0, 1e-8);
  }
}

// However steeply it goes in: a disc that stands on its edge, within the ball by 0.5 mm.
TEST(RimMinimum, AnEdgeThatGoesInSteeplyIsFound) {
  constexpr double kBall = 30, kOverlap = 0.5;
  for (const double tilt : {0.2, 1.2, M_PI / 2, 1.8}) {
    ContactPair pair;
    pair.on_B = make_sphere({0, 0, -kBall}, kBall, true);
    pair.on_A = make_plane(kOrigin, -kUp, kRadius);
    // The edge's lowest point is at (kRadius, 0, 0) of the disc.
    const Eigen::Matrix3d R = exp_rotation({0, tilt, 0});
    const RigidTransform X{R, Vector3d(0, 0, -kOverlap) - R * Vector3d(kRadius, 0, 0)};
    ContactSearch search(pair);
    std::vector<GapMinimum> minima;
    search.find(X, 0, minima);
    ASSERT_FALSE(minima.empty()) << tilt;
    EXPECT_NEAR(minima.front().gap, -kOverlap, 0.01) << tilt;
  }
}

}  // namespace
}  // namespace condyle
