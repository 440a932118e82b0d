/// The known part of a patch with a layer: wider than that of one with points of contact, as far as
/// the mesh goes on, and true there. On the phantom, whose exact bones are known.

#include <gtest/gtest.h>

#include <cmath>

#include "condyle/scene_file/read_scene.h"
#include "condyle/specimen/fit_surfaces.h"
#include "condyle/surface/grow_region.h"
#include "phantom/phantom_shape.h"

namespace condyle {
namespace {

/// Squares of 1 mm, 10 each way, in two triangles each; vertex i, j at (i, j, 0).
TriangleMesh flat_sheet() {
  TriangleMesh mesh;
  constexpr int kSide = 11;
  for (int i = 0; i < kSide; ++i)
    for (int j = 0; j < kSide; ++j) mesh.vertices.emplace_back(i, j, 0);
  for (int i = 0; i + 1 < kSide; ++i)
    for (int j = 0; j + 1 < kSide; ++j) {
      const int a = i * kSide + j, b = a + kSide;
      mesh.triangles.push_back({a, b, b + 1});
      mesh.triangles.push_back({a, b + 1, a + 1});
    }
  return mesh;
}

/// Greatest x of the triangles that are kept [mm].
double reach(const TriangleMesh& mesh, const std::vector<bool>& keep) {
  double most = 0;
  for (std::size_t t = 0; t < keep.size(); ++t)
    if (keep[t])
      for (const int v : mesh.triangles[t]) most = std::max(most, mesh.vertices[v].x());
  return most;
}

TEST(GrowRegion, GoesOnAsFarAsItIsToldAndWhereItMay) {
  const TriangleMesh mesh = flat_sheet();
  std::vector<bool> strip, all(mesh.vertices.size(), true), up_to_4 = all;
  for (const auto& [a, b, c] : mesh.triangles) strip.push_back(mesh.vertices[b].x() < 1.5);
  for (std::size_t i = 0; i < up_to_4.size(); ++i) up_to_4[i] = mesh.vertices[i].x() < 4.5;
  EXPECT_EQ(reach(mesh, strip), 1);
  EXPECT_EQ(grow_region(mesh, strip, all, 0), strip);
  EXPECT_EQ(reach(mesh, grow_region(mesh, strip, all, 3.9)), 4);
  EXPECT_EQ(reach(mesh, grow_region(mesh, strip, all, 4)), 5);
  EXPECT_EQ(reach(mesh, grow_region(mesh, strip, up_to_4, 100)), 4);
  EXPECT_EQ(grow_region(mesh, strip, all, 100), std::vector<bool>(mesh.triangles.size(), true));
}

struct LayeredPhantom : testing::Test {
  Scene scene = read_scene(CONDYLE_SOURCE_DIR "/data/phantom/layered.toml");

  [[nodiscard]] Scene rigid() const {
    Scene other = scene;
    for (ContactDescription& contact : other.contacts) contact.layer.reset();
    return other;
  }
};

// 4 mm along the mesh, less where it bends away: the new part is on the bone, if not as well as the
// middle, and nothing that was known is lost.
TEST_F(LayeredPhantom, IsKnownFartherOutAndTrueThere) {
  const std::vector<FittedSurface> layered = fit_surfaces(scene), points = fit_surfaces(rigid());
  for (std::size_t i = 0; i < layered.size(); ++i) {
    const Surface &wide = *layered[i].surface, &narrow = *points[i].surface;
    const phantom::Bone bone =
        scene.surfaces[i].body == 0 ? phantom::Bone::kFemur : phantom::Bone::kTibia;
    for (const Place& place : narrow.samples(1)) {
      const Eigen::Vector3d p = narrow.evaluate(place).c;
      EXPECT_GT(wide.edge_distance(wide.closest(p, wide.seed(p))), 0) << scene.surfaces[i].name;
    }
    double square = 0, count = 0;
    for (const Place& place : wide.samples(1)) {
      const SurfacePoint at = wide.evaluate(place);
      if (narrow.edge_distance(narrow.closest(at.c, narrow.seed(at.c))) >= 0) continue;
      const SurfacePoint exact = phantom::surface_point(bone, at.c);
      EXPECT_GT(at.n.dot(exact.n), 0.5) << scene.surfaces[i].name;
      square += (at.c - exact.c).squaredNorm();
      ++count;
    }
    EXPECT_LT(std::sqrt(square / count), 0.3) << scene.surfaces[i].name;
    EXPECT_GT(layered[i].report->area, 1.15 * points[i].report->area) << scene.surfaces[i].name;
    EXPECT_NEAR(layered[i].report->smoothing_length, points[i].report->smoothing_length, 0.05);
  }
}

// Where the scene says how far a patch reaches, it ends there with or without a layer.
TEST_F(LayeredPhantom, EndsWhereTheSceneSaysThatItDoes) {
  scene.surfaces[0].patch.region_angles = {{-0.8, 1.6}};
  scene.surfaces[1].patch.region_least_cosine = 0.6;
  const std::vector<FittedSurface> layered = fit_surfaces(scene), points = fit_surfaces(rigid());
  for (const std::size_t i : {0, 1})
    EXPECT_EQ(layered[i].region.triangles, points[i].region.triangles) << scene.surfaces[i].name;
  EXPECT_GT(layered[2].region.triangles.size(), points[2].region.triangles.size());
}

}  // namespace
}  // namespace condyle
