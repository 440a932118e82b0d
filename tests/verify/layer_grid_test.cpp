/// The verifier's own force of layers, against closed forms.

#include "condyle/verify/layer_grid.h"

#include <gtest/gtest.h>

#include <cmath>

namespace condyle::verification {
namespace {

constexpr double kModulus = 10, kPoisson = 0.3, kLayer = 2;

/// A solid that moves over a floor without bounds, which has the layer.
struct OnALayer {
  explicit OnALayer(const SurfaceDescription& solid) {
    SurfaceDescription floor;
    floor.kind = SurfaceKind::kPlane;
    floor.elastic = ElasticSurface{kModulus, kPoisson, kLayer};
    scene.surfaces = {floor, solid};
    for (const SurfaceDescription& surface : scene.surfaces)
      sides.push_back(make_exact_side(surface));
    pair = {0, 1, sides[0].get(), sides[1].get()};
  }
  [[nodiscard]] std::optional<LayerResultant> pressed(double height) const {
    return resultant_on_grid(pair, {Eigen::Matrix3d::Identity(), Vector3d(0, 0, height)},
                             LayersInSeries(scene, pair, PressureLaw::kLinear));
  }

  Scene scene;
  std::vector<std::unique_ptr<SurfaceSide>> sides;
  PairOfSides pair;
};

/// Pressure over depth [N/mm³].
double bedding() {
  return kModulus * (1 - kPoisson) / ((1 + kPoisson) * (1 - 2 * kPoisson)) / kLayer;
}

SurfaceDescription round(SurfaceKind kind, double radius, double minor = 0) {
  SurfaceDescription surface;
  surface.kind = kind;
  surface.radius = radius;
  surface.minor_radius = minor;
  return surface;
}

// Points of a ball press the floor over a cap of area 2πRd, as deep as they lie: F = k π R d².
TEST(LayerGrid, ABallOfAnySize) {
  for (const double radius : {2.0, 20.0, 1e3, 1e5})
    for (const double depth : {0.02, 0.5}) {
      const std::optional<LayerResultant> found =
          OnALayer(round(SurfaceKind::kSphere, radius)).pressed(radius - depth);
      ASSERT_TRUE(found) << radius;
      const double force = bedding() * M_PI * radius * depth * depth;
      EXPECT_NEAR(found->force.z(), force, 0.005 * (force + kLightForce))
          << radius << ", " << depth;
      EXPECT_LE(found->deepest, depth * (1 + 1e-9));
      EXPECT_GE(found->deepest, 0.5 * depth);
    }
}

// A ring's tube presses along a strip half a millimetre wide: 4π R r k ((d - r) v + r sin v) with cos v = 1 - d/r.
TEST(LayerGrid, AThinRing) {
  const double major = 40, minor = 0.5, depth = 0.06;
  const std::optional<LayerResultant> found =
      OnALayer(round(SurfaceKind::kTorus, major, minor)).pressed(minor - depth);
  ASSERT_TRUE(found);
  const double v = std::acos(1 - depth / minor);
  const double force =
      4 * M_PI * major * minor * bedding() * ((depth - minor) * v + minor * std::sin(v));
  EXPECT_NEAR(found->force.z(), force, 0.005 * force);
}

TEST(LayerGrid, WhatIsApartPressesNothing) {
  const std::optional<LayerResultant> found =
      OnALayer(round(SurfaceKind::kSphere, 20)).pressed(20.001);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->sum, 0);
  EXPECT_EQ(found->points, 0);
}

}  // namespace
}  // namespace condyle::verification
