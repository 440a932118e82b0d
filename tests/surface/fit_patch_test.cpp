#include "condyle/surface/fit_patch.h"

#include <gtest/gtest.h>

#include <cmath>

#include "condyle/input_error.h"
#include "condyle/mesh/mesh_measures.h"
#include "condyle/surface/fit_figures.h"
#include "support/mesh_shapes.h"

namespace condyle {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using namespace test;

/// A sheet over the (x, y) plane as a region, facing up.
ArticularRegion region_of(TriangleMesh mesh) {
  ArticularRegion region;
  region.normals = vertex_normals(mesh);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    region.chart.emplace_back(mesh.vertices[i].head<2>());
    region.slope.push_back(region.normals[i].z());
  }
  region.mesh = std::move(mesh);
  return region;
}

constexpr double kRadius = 25;
double ball(double x, double y) { return std::sqrt(kRadius * kRadius - x * x - y * y); }

struct BallErrors {
  double position = 0, curvature = 0;  ///< greatest, away from the edge
};
/// A ball of 25 mm over a square of 24 mm, fitted almost without smoothing.
BallErrors fit_ball(int control_points) {
  const ArticularRegion region = region_of(height_sheet(24, 80, ball));
  const PatchFit fit = fit_patch(region, {.control_points = {{control_points, control_points}},
                                          .smoothing_length = 0.05,
                                          .rounds = 10,
                                          .settled = 1e-9});
  const Patch patch(fit.patch);
  BallErrors errors;
  for (double u = -6; u <= 6; u += 0.31)
    for (double v = -6; v <= 6; v += 0.37) {
      const SurfacePoint at = patch.evaluate(Patch::place(u, v));
      errors.position = std::max(errors.position, std::abs(at.c.norm() - kRadius));
      const Eigen::Matrix3d exact =
          (at.c.normalized() * at.c.normalized().transpose() - Eigen::Matrix3d::Identity()) /
          kRadius;
      errors.curvature = std::max(errors.curvature, (at.K - exact).norm());
    }
  return errors;
}

// Bicubic splines are of order 4 in position and 2 in curvature: halving the knot spacing divides
// the errors by 16 and 4.
TEST(FitPatch, ConvergesOnASphereWithTheOrderOfSplines) {
  const BallErrors coarse = fit_ball(3 + 5), fine = fit_ball(3 + 10);
  EXPECT_GT(coarse.position / fine.position, 16 * 0.7);
  EXPECT_GT(coarse.curvature / fine.curvature, 4 * 0.8);
  EXPECT_LT(fine.position, 1e-4);
  EXPECT_LT(fine.curvature, 1e-3 / kRadius * 25);
}

// The third-derivative penalty leaves a parabola alone, whatever the smoothing length.
TEST(FitPatch, ReproducesAParabolicSheetUnderAnySmoothing) {
  const ArticularRegion region =
      region_of(height_sheet(30, 30, [](double x, double y) { return 1e-3 * (x * x - x * y); }));
  const FitFigures figures = measure_fit(region, fit_patch(region, {.smoothing_length = 4}));
  EXPECT_LT(figures.max, 2e-4);
}

TEST(FitPatch, PointsItsNormalOutOfTheBone) {
  TriangleMesh up = height_sheet(24, 24, ball);
  ArticularRegion region = region_of(up);
  EXPECT_GT(Patch(fit_patch(region).patch).evaluate(Patch::place(0, 0)).n.z(), 0.99);
  for (Vector3d& n : region.normals) n = -n;
  const Patch socket(fit_patch(region, {.smoothing_length = 0.5}).patch);
  EXPECT_LT(socket.evaluate(Patch::place(0, 0)).n.z(), -0.99);
  EXPECT_NEAR(socket.evaluate(Patch::place(0, 0)).K(0, 0), 1 / kRadius,
              2e-3);  // a socket is concave
}

// With texture on it, what is smoothed away must not depend on how finely the texture is sampled.
TEST(FitPatch, SmoothsTheSameOnCoarseAndFineMeshes) {
  const auto rough = [](double x, double y) {
    return ball(x, y) + 0.1 * std::sin(1.1 * x + 0.3) * std::cos(1.3 * y);
  };
  const FitOptions options{.control_points = {{13, 13}}, .smoothing_length = 2};
  const Patch coarse(fit_patch(region_of(height_sheet(24, 24, rough)), options).patch);
  const Patch fine(fit_patch(region_of(height_sheet(24, 96, rough)), options).patch);
  double greatest = 0;
  for (double u = -8; u <= 8; u += 0.5)
    for (double v = -8; v <= 8; v += 0.5)
      greatest = std::max(
          greatest,
          (coarse.evaluate(Patch::place(u, v)).c - fine.evaluate(Patch::place(u, v)).c).norm());
  EXPECT_LT(greatest, 0.01);  // a tenth of the texture
}

// Distances are measured at right angles: on a ball with vertices moved out by 0.1 mm they are 0.1
// mm everywhere, on the slopes too.
TEST(FitPatch, MeasuresDistancesAtRightAngles) {
  ArticularRegion region = region_of(height_sheet(30, 60, ball));
  PatchFit fit = fit_patch(region, {.smoothing_length = 0.5});
  const FitFigures near = measure_fit(region, fit);
  EXPECT_LT(near.max, 0.01);
  EXPECT_NEAR(near.curvature_range[0], -1 / kRadius, 1e-3);
  EXPECT_NEAR(near.curvature_range[1], -1 / kRadius, 1e-3);
  EXPECT_LT(near.core_normal_rms, 1e-2);
}

/// The triangles of a disc of radius 12 mm out of a sheet, without those around `hole` (radius in
/// mm).
ArticularRegion disc(int cells, double hole) {
  const TriangleMesh sheet = height_sheet(30, cells, ball);
  std::vector<bool> keep;
  for (const auto& [a, b, c] : sheet.triangles) {
    const Vector2d p = ((sheet.vertices[a] + sheet.vertices[b] + sheet.vertices[c]) / 3).head<2>();
    keep.push_back(p.norm() < 12 && (p - Vector2d(3, 2)).norm() > hole);
  }
  return region_of(sub_mesh(sheet, keep).mesh);
}

// The mask is the distance to the rim of the disc, less the margin that is not known, whatever the
// mesh: 12 mm from the middle along the plane, on the ball R asin(12/R) = 12.5 mm as the arc
// and 12.3 mm straight. A ragged rim of triangles shifts it by less than an edge.
TEST(FitPatch, KnowsHowFarTheEdgeOfTheDataIs) {
  for (const int cells : {15, 60}) {  // edges of 2 and 0.5 mm
    const PatchFit fit = fit_patch(disc(cells, 0));
    const Patch patch(fit.patch);
    const double edge = 30.0 / cells, rim = fit.rim;
    EXPECT_NEAR(patch.edge_distance(Patch::place(0, 0)) + rim, 12.3, edge + 0.3);
    EXPECT_NEAR(patch.edge_distance(Patch::place(9, 0)) + rim, 3.3, edge + 0.3);
    EXPECT_LT(patch.edge_distance(Patch::place(9.6, 9.6)) + rim,
              0);  // 13.6 mm out: in the box, off the disc
    for (double r = 0; r < 12 - 1.5 * edge; r += 0.4)
      for (double a = 0; a < 6.28; a += 0.3)
        EXPECT_GT(patch.edge_distance(Patch::place(r * std::cos(a), r * std::sin(a))) + rim, 0)
            << r << " " << a;
  }
}

TEST(FitPatch, BridgesASmallHoleAndLeavesAWideOneOut) {
  const PatchFit small = fit_patch(disc(60, 1)), wide = fit_patch(disc(60, 4));
  EXPECT_GT(Patch(small.patch).edge_distance(Patch::place(3, 2)), 5);
  EXPECT_LT(Patch(wide.patch).edge_distance(Patch::place(3, 2)), -2);
  ASSERT_EQ(small.notes.size(), 1u);
  EXPECT_NE(small.notes[0].find("bridged"), std::string::npos);
  EXPECT_EQ(small.holes.count, 0);
  EXPECT_EQ(wide.holes.count, 1);
  EXPECT_GT(wide.holes.perimeter, 2 * M_PI * 4);
  EXPECT_LT(wide.holes.perimeter, 8 * 4 + 2) << "steps along it, of 0.5 mm";
  EXPECT_LT((wide.holes.middle.head<2>() - Vector2d(3, 2)).norm(), 0.2);
}

// Away from the disc the patch goes on without bending. At (12, 12), 5 mm beyond the rim at r = 12,
// the tangent cone of the ball has z = 21.93 - 0.547 * 4.97 = 19.2.
TEST(FitPatch, GoesOnSmoothlyBeyondTheData) {
  const Patch patch(fit_patch(disc(60, 0)).patch);
  const Vector3d corner = patch.evaluate(Patch::place(12, 12)).c;
  EXPECT_NEAR(corner.x(), 12, 1);
  EXPECT_NEAR(corner.y(), 12, 1);
  EXPECT_NEAR(corner.z(), 19.2, 1);
}

TEST(FitPatch, FitsDegreeFive) {
  const ArticularRegion region = region_of(height_sheet(24, 40, ball));
  const PatchFit fit = fit_patch(region, {.smoothing_length = 0.5, .degree = 5});
  EXPECT_EQ(fit.patch.degree[0], 5);
  EXPECT_LT(measure_fit(region, fit).core_max, 1e-3);
}

TEST(FitPatch, RefusesRegionsTooSmallForTheirControlPoints) {
  const ArticularRegion region = region_of(height_sheet(24, 8, ball));  // 81 vertices
  EXPECT_THROW((void)fit_patch(region, {.control_points = {{12, 12}}}), InputError);
  EXPECT_THROW((void)fit_patch(region, {.control_points = {{3, 12}}}), InputError);
  EXPECT_THROW((void)fit_patch(region_of(height_sheet(24, 3, ball))), InputError);
}

// Work and memory grow with the fourth and third power of the side.
TEST(FitPatch, RefusesRegionsTooLargeForTheirControlPoints) {
  const auto flat = [](double, double) { return 0.0; };
  const ArticularRegion region = region_of(height_sheet(300, 20, flat));
  try {
    (void)fit_patch(region);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("expected no more than 16000 in all"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace condyle
