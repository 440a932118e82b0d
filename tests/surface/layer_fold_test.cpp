/// Layers that are thicker than a surface's convex radii: measured on a ball, refused and warned of
/// on the phantom.

#include "condyle/surface/layer_fold.h"

#include <gtest/gtest.h>

#include <cmath>

#include "condyle/input_error.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/specimen/fit_surfaces.h"
#include "condyle/surface/exact_surfaces.h"

namespace condyle {
namespace {

TEST(LayerFold, IsWhereALayerReachesTheCentreOfABall) {
  const auto ball = make_sphere({1, 2, 3}, 10, true), socket = make_sphere({1, 2, 3}, 10, false);
  EXPECT_EQ(layer_fold(*ball, 9.99).area, 0);
  EXPECT_EQ(layer_fold(*ball, 10.01).share(), 1);
  EXPECT_NEAR(layer_fold(*ball, 10).known / (400 * M_PI), 1, 1e-3);
  EXPECT_NEAR(layer_fold(*ball, 1).least_radius, 10, 1e-9);
  EXPECT_EQ(layer_fold(*socket, 1000).area, 0);
  EXPECT_TRUE(std::isinf(layer_fold(*socket, 1000).least_radius));
}

// A torus of radii 20 and 5: its inner side is a saddle, and as convex along the small circle.
TEST(LayerFold, SeesTheSmallerOfTwoRadii) {
  const auto ring = make_torus({0, 0, 0}, {0, 0, 1}, 20, 5, true);
  EXPECT_NEAR(layer_fold(*ring, 4.9).least_radius, 5, 1e-9);
  EXPECT_EQ(layer_fold(*ring, 4.9).area, 0);
  EXPECT_EQ(layer_fold(*ring, 5.1).share(), 1);
}

Scene layered_phantom(double layer) {
  Scene scene = read_scene(CONDYLE_SOURCE_DIR "/data/phantom/layered.toml");
  for (SurfaceDescription& surface : scene.surfaces) surface.elastic->layer = layer;
  return scene;
}

std::string message_of(const Scene& scene) {
  try {
    (void)fit_surfaces(scene);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

bool warns_of_a_layer(const Scene& scene) {
  for (const FittedSurface& surface : fit_surfaces(scene))
    for (const std::string& note : surface.report->notes)
      if (note.find("warning: a layer of ") == 0) return true;
  return false;
}

// Condyles of 20 mm have no room for 30; the bends of a rough plateau's rim are let pass.
TEST(LayerFold, IsRefusedOverMuchOfAPatch) {
  const std::string message = message_of(layered_phantom(30));
  EXPECT_NE(message.find("layered.toml:34: [[surface]] \"medial condyle\": layer = 30, expected a "
                         "thickness less than the radii of curvature of its surface"),
            std::string::npos)
      << message;
  EXPECT_FALSE(warns_of_a_layer(layered_phantom(3)));
  EXPECT_TRUE(warns_of_a_layer(layered_phantom(8)));
  Scene rigid = layered_phantom(30);
  for (ContactDescription& contact : rigid.contacts) contact.layer.reset();
  EXPECT_EQ(message_of(rigid), "");
}

// The height -x²/24 bends with a radius of 12 mm at its top.
TEST(LayerFold, IsRefusedAnywhereOfAPolynomial) {
  Scene scene = layered_phantom(11);
  SurfaceDescription& hill = scene.surfaces[1];
  hill.kind = SurfaceKind::kPolynomial;
  hill.terms = {{2, 0, -1.0 / 24}};
  hill.known_radius = 15;
  hill.solid_inside = true;
  for (SurfaceDescription& surface : scene.surfaces)
    if (&surface != &hill) surface.elastic.reset();
  EXPECT_EQ(message_of(scene), "");
  hill.elastic->layer = 12.1;
  EXPECT_NE(message_of(scene).find("layer = 12.1, expected"), std::string::npos);
}

}  // namespace
}  // namespace condyle
