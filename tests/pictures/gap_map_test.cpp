#include "condyle/pictures/gap_map.h"

#include <gtest/gtest.h>

#include <cmath>

#include "condyle/pictures/color_map.h"
#include "condyle/pictures/knee_shapes.h"
#include "support/block_knee.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

constexpr double kRadius = 20, kHeight = 1;  // of a ball above a plane [mm]

const std::vector<RigidTransform> kAsModelled(2);

TEST(GapMap, IsTheDistanceToTheNearestPointOfTheOtherSurface) {
  const auto run = ball_over_plane(kRadius, kHeight);
  const GapMap map(run);
  for (const double r : {0.0, 5.0, 15.0}) {
    const GapMap::Gap gap = map.gap(1, {r, 0, 0}, {0, 1, 0}, kAsModelled);
    // From a point of the plane to the ball: the distance to its centre less its radius.
    EXPECT_NEAR(gap.width, std::hypot(r, kRadius + kHeight) - kRadius, 1e-9) << r;
    EXPECT_GE(gap.inside, 0);
  }
  // From the ball to the plane: the height.
  const Vector3d down = Vector3d(1, -2, 0).normalized();
  const Vector3d on_ball = Vector3d(0, kRadius + kHeight, 0) + kRadius * down;
  EXPECT_NEAR(map.gap(0, on_ball, down, kAsModelled).width, on_ball.y(), 1e-9);
}

TEST(GapMap, FollowsThePosesOfTheBodies) {
  const auto run = ball_over_plane(kRadius, kHeight);
  std::vector<RigidTransform> X_P(2);
  X_P[0].p = {0, 2.5, 0};
  EXPECT_NEAR(GapMap(run).gap(1, {0, 0, 0}, {0, 1, 0}, X_P).width, kHeight + 2.5, 1e-9);
  X_P[0].p = {0, -1.25, 0};
  EXPECT_NEAR(GapMap(run).gap(1, {0, 0, 0}, {0, 1, 0}, X_P).width, -0.25, 1e-9) << "overlap";
}

TEST(GapMap, SaysNothingBeyondTheKnownSurfaceAndOnTheFarSide) {
  const auto run = ball_over_plane(kRadius, kHeight);
  const GapMap map(run);
  std::vector<RigidTransform> X_P(2);
  X_P[0].p = {70, 0, 0};
  EXPECT_LT(map.gap(0, {0, kHeight, 0}, {0, -1, 0}, X_P).inside, 0) << "the plane ends at 50 mm";
  const Vector3d top(0, 2 * kRadius + kHeight, 0);
  EXPECT_LT(map.gap(0, top, {0, 1, 0}, kAsModelled).inside, 0) << "it looks away from the plane";
}

TEST(GapMap, PaintsTouchingDarkAndFarPale) {
  const auto run = ball_over_plane(kRadius, kHeight);
  ShadedMesh mesh;
  for (const double r : {0.0, 20.0})
    mesh.vertices.push_back({Eigen::Vector3f(static_cast<float>(r), 0, 0), {0, 1, 0}, {}});
  GapMap(run).paint(mesh, 1, kAsModelled, kCartilage);
  const auto color = [&](std::size_t i) {
    return Rgb{mesh.vertices[i].color[0], mesh.vertices[i].color[1], mesh.vertices[i].color[2]};
  };
  EXPECT_EQ(color(0), map_color(ColorMap::kGap, kHeight / kGapLimit));
  EXPECT_EQ(color(1), map_color(ColorMap::kGap, 1)) << "9 mm: beyond the scale";
}

TEST(GapMap, ColoursGrowLighterFromTouchingToFar) {
  double before = -1;
  for (int i = 0; i <= 60; ++i) {
    const Rgb c = map_color(ColorMap::kGap, i / 60.0);
    const double lightness = 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
    EXPECT_GT(lightness, before) << i;  // so that grey printing and colour blindness do not matter
    before = lightness;
  }
}

TEST(GapMap, PaintsOverlapInAColourOutsideOfTheScaleAndSaysHowDeep) {
  const auto run = ball_over_plane(kRadius, kHeight);
  std::vector<RigidTransform> X_P(2);
  X_P[0].p = {0, -1.25, 0};  // the ball's lowest point 0.25 mm below the plane
  ShadedMesh mesh;
  for (const double r : {0.0, 20.0})
    mesh.vertices.push_back({Eigen::Vector3f(static_cast<float>(r), 0, 0), {0, 1, 0}, {}});
  EXPECT_NEAR(GapMap(run).paint(mesh, 1, X_P, kCartilage), 0.25, 1e-6);
  const auto color = [&](std::size_t i) {
    return Rgb{mesh.vertices[i].color[0], mesh.vertices[i].color[1], mesh.vertices[i].color[2]};
  };
  EXPECT_EQ(color(0), kAlarmColor);
  EXPECT_NE(color(1), kAlarmColor);
  X_P[0].p = {0, -1, 0};  // touching
  EXPECT_EQ(GapMap(run).paint(mesh, 1, X_P, kCartilage), 0);
  EXPECT_EQ(color(0), map_color(ColorMap::kGap, 0));
}

/// What the red-blind and the green-blind see, in linear light [Viénot et al. 1999].
Vector3d seen_without(bool red, Rgb c) {
  Vector3d x;
  for (int i = 0; i < 3; ++i) x[i] = std::pow(c[static_cast<std::size_t>(i)] / 255.0, 2.2);
  Eigen::Matrix3d M;
  if (red)
    M << 0.11238, 0.88762, 0, 0.11238, 0.88762, 0, 0.00401, -0.00401, 1;
  else
    M << 0.29275, 0.70725, 0, 0.29275, 0.70725, 0, -0.02234, 0.02234, 1;
  const Vector3d seen = M * x;
  return seen.cwiseMax(0).array().pow(1 / 2.2);
}

TEST(GapMap, OverlapLooksLikeNoGapWithoutColourVisionEither) {
  for (const bool red : {true, false}) {
    const Vector3d alarm = seen_without(red, kAlarmColor);
    for (int i = 0; i <= 60; ++i) {
      const Vector3d gap = seen_without(red, map_color(ColorMap::kGap, i / 60.0));
      EXPECT_GT((gap - alarm).norm(), 0.3) << i;
    }
    EXPECT_GT((seen_without(red, kCartilage.color) - alarm).norm(), 0.5);
  }
}

}  // namespace
}  // namespace condyle
