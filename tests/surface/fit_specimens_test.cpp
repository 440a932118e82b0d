/// Patches fitted to living knees, and to meshes of different resolution.

#include "condyle/specimen/fit_surfaces.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "condyle/scene_file/read_scene.h"
#include "support/specimens.h"
#include "surface/fitted_knee.h"

namespace condyle {
namespace {

using test::knee;
using test::KneeFiles;
using test::rim_of;
namespace fs = std::filesystem;

using test::kSpecimens;

struct Limits {
  double rms, max, normal_degrees;
};
void expect_core(const Scene& scene, const Limits& limits) {
  for (const FittedSurface& fitted : fit_surfaces(scene)) {
    const FitReport& report = *fitted.report;
    EXPECT_LE(report.core_rms, limits.rms) << report.surface;
    EXPECT_LE(report.core_max, limits.max) << report.surface;
    EXPECT_LE(report.normal_rms * 180 / M_PI, limits.normal_degrees) << report.surface;
  }
}

/// With the smoothing chosen for position and for normals, which is twice as long.
void expect_core(Scene scene, const Limits& for_position, const Limits& for_normals) {
  expect_core(scene, for_normals);
  for (SurfaceDescription& surface : scene.surfaces) surface.patch.smooth_for_position = true;
  expect_core(scene, for_position);
}

// A living knee: what is wanted of its fit was measured with a prototype beforehand.
TEST(FitSpecimens, FollowsTheCartilageOfALivingKnee) {
  const fs::path folder = kSpecimens / "lenhart2015";
  if (!fs::exists(folder)) GTEST_SKIP() << "no specimens here";
  expect_core(knee({.femur = folder / "ACLC01-R-femur-cart.obj",
                    .tibia = folder / "ACLC01-R-tibia-cart.obj",
                    .to_mm = 1000}),
              {.rms = 0.06, .max = 0.25, .normal_degrees = 2.5},
              {.rms = 0.075, .max = 0.3, .normal_degrees = 2.5});
}

KneeFiles lenhart_files(const std::string& resolution) {
  const fs::path folder = kSpecimens / "lenhart2015";
  return {.femur = folder / ("ACLC01-R-femur-cart" + resolution),
          .tibia = folder / ("ACLC01-R-tibia-cart" + resolution),
          .to_mm = 1000};
}

/// rms difference of curvature between the patches of two knees, farther than 4 mm from both edges
/// and where neither bends with a radius below `least_radius` [mm].
double curvature_difference(const FittedSurface& a,
                            const FittedSurface& b,
                            const EdgeSmoothing& edge,
                            double least_radius) {
  const double rim_a = rim_of(a, edge), rim_b = rim_of(b, edge);
  double square = 0, count = 0;
  for (const Place& place : a.surface->samples(1.0)) {
    const SurfacePoint at = a.surface->evaluate(place);
    const Place other = b.surface->closest(at.c, b.surface->seed(at.c));
    if (a.surface->edge_distance(place) + rim_a < 4 || b.surface->edge_distance(other) + rim_b < 4)
      continue;
    const SurfacePoint opposite = b.surface->evaluate(other);
    if (std::max(at.K.norm(), opposite.K.norm()) * least_radius > 1) continue;
    square += (at.K - opposite.K).squaredNorm() / 2;  // two curvatures
    ++count;
  }
  return std::sqrt(square / count);
}

// Three meshes of one knee, 13, 3 and 1 thousand vertices for the femur: what they differ in must
// not look like curvature. Limits from a prototype with smoothing lengths fixed at 2 and 1.5 mm,
// whose regions ended before the shoulder of the eminence: there, where the bone bends with radii
// of 4 to 10 mm, the difference may be larger.
TEST(FitSpecimens, FindsTheSameCurvatureInMeshesOfDifferentResolution) {
  if (!fs::exists(kSpecimens / "lenhart2015")) GTEST_SKIP() << "no specimens here";
  // With the flanks smoothed by 0.9 mm, by a choice for normals, in place of 1.0 by one for position.
  struct CurvatureLimits {
    EdgeSmoothing edge;
    double wide, all, most;  // [1/mm]
  };
  for (const bool for_position : {true, false}) {
    const auto fitted = [for_position](const std::string& resolution) {
      Scene scene = knee(lenhart_files(resolution));
      for (SurfaceDescription& surface : scene.surfaces)
        surface.patch.smooth_for_position = for_position;
      return fit_surfaces(scene);
    };
    const auto [edge, wide, all, most] = for_position
                                             ? CurvatureLimits{kPlainEdge, 0.0006, 0.001, 0.003}
                                             : CurvatureLimits{kNormalsEdge, 0.001, 0.002, 0.003};
    const auto full = fitted(".obj"), medium = fitted("-medium.stl"),
               coarse = fitted("-coarse.stl");
    for (std::size_t i = 0; i < full.size(); ++i) {
      SCOPED_TRACE(full[i].report->surface);
      EXPECT_LT(curvature_difference(full[i], medium[i], edge, 10), wide);
      EXPECT_LT(curvature_difference(full[i], medium[i], edge, 0), all);
      EXPECT_LT(curvature_difference(full[i], coarse[i], edge, 0), most);
    }
  }
}

TEST(FitSpecimens, FollowsTheMeanKneeOfAShapeModel) {
  const fs::path folder = kSpecimens / "clouthier2019_ssm";
  if (!fs::exists(folder)) GTEST_SKIP() << "no specimens here";
  expect_core(knee({.femur = folder / "mean_Femur_Cartilage.ply",
                    .tibia = folder / "mean_Tibia_Cartilage_shifted.ply",
                    .to_mm = 1,
                    .lateral = {1, 0, 0},
                    .anterior = {0, 1, 0},
                    .proximal = {0, 0, 1}}),
              {.rms = 0.04, .max = 0.25, .normal_degrees = 2.5},
              {.rms = 0.06, .max = 0.3, .normal_degrees = 2.5});
}

/// Closed slabs of cartilage from MRI, with the staircase of its voxels.
struct Slabs : testing::Test {
  Scene scene;
  void SetUp() override {
    if (!fs::exists(kSpecimens / "oai_pymskt")) GTEST_SKIP() << "no specimens here";
    scene = read_scene(fs::path(CONDYLE_SOURCE_DIR) / "tests/data/oai_pymskt.toml");
  }
};

// Normals of a staircase are those of its steps: 6.6 degrees on the plateaus.
TEST_F(Slabs, AreFollowedOnTheirOuterFaces) {
  for (SurfaceDescription& surface : scene.surfaces) {
    surface.patch.smoothing.reset();
    surface.patch.smooth_for_position = true;
  }
  for (const FittedSurface& fitted : fit_surfaces(scene)) {
    const bool condyle = fitted.report->surface.ends_with("condyle");
    EXPECT_LE(fitted.report->core_rms, condyle ? 0.055 : 0.07) << fitted.report->surface;
    EXPECT_LE(fitted.report->normal_rms * 180 / M_PI, condyle ? 2.5 : 7) << fitted.report->surface;
  }
}

// Chosen for normals the smoothing takes the steps for texture, and leaves more of them.
TEST_F(Slabs, AreSmoothedOverTheirSteps) {
  for (SurfaceDescription& surface : scene.surfaces) surface.patch.smoothing.reset();
  for (const FittedSurface& fitted : fit_surfaces(scene)) {
    EXPECT_GT(fitted.report->smoothing_length, 2.5) << fitted.report->surface;
    EXPECT_LE(fitted.report->core_rms, 0.1) << fitted.report->surface;
  }
}

// The inner face lies 2 to 4 mm deeper: a patch that mixed both would leave the mesh by a
// millimetre.
TEST_F(Slabs, LeaveTheirInnerFacesOut) {
  for (const FittedSurface& fitted : fit_surfaces(scene)) {
    EXPECT_LT(fitted.report->p95, 0.6) << fitted.report->surface;
    EXPECT_GT(fitted.report->area, 500) << fitted.report->surface;
    EXPECT_LT(fitted.report->area, 2300) << fitted.report->surface;
  }
}

}  // namespace
}  // namespace condyle
