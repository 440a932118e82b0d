#include "condyle/reference/fit_heights.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <limits>

#include "condyle/input_error.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/specimen/fit_surfaces.h"
#include "support/random.h"

namespace condyle {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

TEST(FitHeights, FindsThePolynomialThatPointsLieOn) {
  test::Random random(11);
  HeightSurface exact;
  exact.origin = random.vector(30);
  exact.axes = random.rotation();
  for (int i = 0; i <= 3; ++i)
    for (int j = 0; i + j <= 3; ++j)
      exact.terms.push_back({i, j, random.between(-1, 1) * std::pow(0.05, i + j)});
  std::vector<Vector3d> points;
  std::vector<double> weights;
  for (int k = 0; k < 200; ++k) {
    points.push_back(evaluate(exact, {random.between(-15, 15), random.between(-10, 10)}).c);
    weights.push_back(random.between(0.5, 2));
  }
  HeightSurface fitted;
  fitted.origin = exact.origin;
  fitted.axes = exact.axes;
  fit_height_polynomial(points, weights, 4, fitted);  // one degree more than is needed
  for (int k = 0; k < 50; ++k) {
    const Vector2d at(random.between(-15, 15), random.between(-10, 10));
    EXPECT_LT((evaluate(fitted, at).c - evaluate(exact, at).c).norm(), 1e-10);
  }
}

TEST(FitHeights, EvaluatesPointNormalAndDerivatives) {
  test::Random random(4);
  HeightSurface surface;
  surface.axes = random.rotation();
  surface.solid_below = false;
  for (int i = 0; i <= 4; ++i)
    for (int j = 0; i + j <= 4; ++j)
      surface.terms.push_back({i, j, random.between(-1, 1) * std::pow(0.1, i + j)});
  const Vector2d at(2.5, -1.5);
  const HeightPoint point = evaluate(surface, at);
  EXPECT_NEAR(point.n.dot(point.t[0]), 0, 1e-14);
  EXPECT_NEAR(point.n.dot(point.t[1]), 0, 1e-14);
  EXPECT_LT(point.n.dot(surface.axes.col(2)), 0);  // the solid lies above
  constexpr double kStep = 1e-5;
  for (int k = 0; k < 2; ++k) {
    const HeightPoint plus = evaluate(surface, at + kStep * Vector2d::Unit(k)),
                      minus = evaluate(surface, at - kStep * Vector2d::Unit(k));
    EXPECT_LT(((plus.c - minus.c) / (2 * kStep) - point.t[k]).norm(), 1e-9);
    EXPECT_LT(((plus.n - minus.n) / (2 * kStep) - point.n_x[k]).norm(), 1e-9);
    for (int l = 0; l < 2; ++l)
      EXPECT_LT(((plus.t[l] - minus.t[l]) / (2 * kStep) - point.c_xx[l][k]).norm(), 1e-9);
  }
}

TEST(FitHeights, KnowsHowFarItsPointsReach) {
  HeightSurface surface;
  surface.outline = convex_outline({{0, 0}, {4, 0}, {4, 2}, {0, 2}, {1, 1}, {2, 0}});
  EXPECT_EQ(surface.outline.size(), 4U);
  EXPECT_DOUBLE_EQ(distance_to_outline(surface, {2, 0.5}), 0.5);
  EXPECT_DOUBLE_EQ(distance_to_outline(surface, {7, 6}), -5);  // 3-4-5 from the corner (4, 2)
  surface.outline.clear();
  EXPECT_TRUE(std::isinf(distance_to_outline(surface, {1e6, 0})));
}

TEST(FitHeights, MeasuresWhatAQuarticLeavesOfASphere) {
  // A sphere of 21 mm seen at up to 65 degrees (half the sweep of 90 and a margin of 20).
  const Scene scene = read_scene(CONDYLE_SOURCE_DIR "/data/wismans-type/knee.toml");
  const std::vector<FittedSurface> surfaces = fit_surfaces(scene);
  const std::vector<HeightFit> quartic = fit_heights(scene, surfaces, 4),
                               sextic = fit_heights(scene, surfaces, 6);
  EXPECT_TRUE(quartic[0].fitted);
  EXPECT_LT(quartic[0].rms, 0.2);
  EXPECT_GT(quartic[0].rms, 2 * sextic[0].rms);
  EXPECT_GT(quartic[0].max, quartic[0].rms);
  EXPECT_FALSE(quartic[2].fitted);  // the plateaus are planes: exact
  EXPECT_EQ(quartic[2].degree, 0);
}

// One femoral ball on two plateaus, 0.2 rad apart: its plane faces between them, whichever contact
// stands first.
TEST(FitHeights, ASurfaceOfTwoContactsFacesBothOppositeOnes) {
  Scene scene = read_scene(CONDYLE_SOURCE_DIR "/data/wismans-type/knee.toml");
  ASSERT_EQ(scene.contacts.size(), 2U);
  for (std::size_t c = 0; c < 2; ++c)
    for (int& surface : scene.contacts[c].surfaces)
      surface =
          scene.surfaces[surface].body == scene.joint->femur.body ? 0 : 2 + static_cast<int>(c);
  const Vector3d level = scene.surfaces[2].direction, aside = scene.joint->tibia.anterior;
  scene.surfaces[2].direction = std::cos(0.1) * level + std::sin(0.1) * aside;
  scene.surfaces[3].direction = std::cos(0.1) * level - std::sin(0.1) * aside;
  const Eigen::Matrix3d axes = fit_heights(scene, fit_surfaces(scene), 4)[0].surface.axes;
  std::swap(scene.contacts[0], scene.contacts[1]);
  EXPECT_EQ(fit_heights(scene, fit_surfaces(scene), 4)[0].surface.axes, axes);
  scene.surfaces[2].direction = scene.surfaces[3].direction = level;
  EXPECT_LT((fit_heights(scene, fit_surfaces(scene), 4)[0].surface.axes - axes).norm(), 1e-14);
}

// Any of its points names a plane without end.
TEST(FitHeights, APlaneWithoutEndIsTheSameWhicheverPointNamesIt) {
  Scene scene = read_scene(CONDYLE_SOURCE_DIR "/data/wismans-type/knee.toml");
  SurfaceDescription& plateau = scene.surfaces[2];
  ASSERT_EQ(plateau.kind, SurfaceKind::kPlane);
  plateau.known_radius = std::numeric_limits<double>::infinity();
  const Vector3d near = fit_heights(scene, fit_surfaces(scene), 4)[2].surface.origin;
  plateau.point += 300 * plateau.direction.unitOrthogonal();
  const Vector3d far = fit_heights(scene, fit_surfaces(scene), 4)[2].surface.origin;
  EXPECT_LT((far - near).norm(), 1e-10);
  EXPECT_LT((near - scene.joint->tibia.origin).norm(), 100);
}

}  // namespace
}  // namespace condyle
