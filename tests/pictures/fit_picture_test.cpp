#include "condyle/pictures/fit_picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "condyle/mesh/mesh_measures.h"
#include "condyle/pictures/fit_map.h"
#include "condyle/surface/fit_patch.h"
#include "support/mesh_shapes.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

constexpr double kBallRadius = 25;

/// A patch through `mesh`, charted by `chart`, as fit_surfaces would hand it over.
template <class Chart>
FittedSurface fitted(const TriangleMesh& mesh, Chart chart) {
  ArticularRegion region;
  region.mesh = mesh;
  region.normals = vertex_normals(mesh);
  for (const Vector3d& p : mesh.vertices) {
    region.chart.push_back(chart(p));
    region.slope.push_back(1);
  }
  FitReport report;
  report.surface = "medial condyle";
  return {std::make_shared<const Patch>(fit_patch(region, {.smoothing_length = 0.5}).patch), report,
          mesh};
}

/// The cap of a ball around z; its mesh then steps 0.09 mm out where x > 0 and in where x < 0.
FittedSurface ball_beside_its_mesh() {
  const auto ball = [](double x, double y) {
    return std::sqrt(kBallRadius * kBallRadius - x * x - y * y);
  };
  FittedSurface surface = fitted(test::height_sheet(24, 60, ball),
                                 [](const Vector3d& p) { return Eigen::Vector2d(p.head<2>()); });
  for (Vector3d& p : surface.region.vertices) p *= 1 + std::copysign(0.09, p.x()) / kBallRadius;
  return surface;
}

Scene one_patch() {
  Scene scene;
  scene.bodies.resize(1);
  scene.surfaces.resize(1);
  scene.surfaces[0].body = 0;
  scene.surfaces[0].kind = SurfaceKind::kPatch;
  return scene;
}

/// Pixels of a part of the picture that are clearly red (sign 1) or blue (sign -1).
int colored(const Image& image, double from, double to, int sign) {
  int count = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = static_cast<int>(from * image.width); x < to * image.width; ++x)
      count += sign * (image.at(x, y)[0] - image.at(x, y)[2]) > 60;
  return count;
}

TEST(FitMap, DeviationIsPositiveWhereTheMeshLiesOutside) {
  const FittedSurface surface = ball_beside_its_mesh();
  const FitMap map = deviation_map(surface);
  EXPECT_DOUBLE_EQ(map.limit, 0.1) << "rounded up from what 99 % stay below";
  for (const double x : {-8.0, -3.0, 3.0, 8.0}) {
    const SurfacePoint at = surface.surface->evaluate(surface.surface->seed({x, 2, 24}));
    EXPECT_NEAR(map.value(at), std::copysign(0.09, x), 2e-3) << x;
  }
}

TEST(FitMap, CurvaturesAreThoseOfABall) {
  const FittedSurface surface = ball_beside_its_mesh();
  const auto& patch = dynamic_cast<const Patch&>(*surface.surface);
  for (const Principal which : {Principal::kGreatest, Principal::kLeast}) {
    const FitMap map = curvature_map(patch, which);
    EXPECT_NEAR(map.value(patch.evaluate(Patch::place(0, 0))), -1 / kBallRadius, 5e-4);
    EXPECT_NEAR(map.limit, 0.045, 0.0051) << "1/25, rounded up";
    EXPECT_EQ(map.unit, "1/mm");
  }
}

// Seen from above with x (anterior, of a scene without [joint]) upwards or to the right.
TEST(FitPicture, ShowsBothSignsAndTheScale) {
  const auto pictures = draw_fit(one_patch(), {ball_beside_its_mesh()});
  ASSERT_EQ(pictures.size(), 2u);
  EXPECT_EQ(pictures[0].name, "medial_condyle_deviation");
  EXPECT_EQ(pictures[1].name, "medial_condyle_curvature");
  const Image& deviation = pictures[0].image;
  EXPECT_EQ(deviation.width, 650) << "one side and the bar";
  EXPECT_EQ(deviation.height, 660);
  const int red = colored(deviation, 0, 0.78, 1), blue = colored(deviation, 0, 0.78, -1);
  EXPECT_GT(red, 20000);
  EXPECT_GT(blue, 20000);
  EXPECT_NEAR(red, blue, 0.1 * red) << "half of the cap each";
  EXPECT_GT(colored(deviation, 0.8, 1, 1), 1000) << "upper half of the bar";
  EXPECT_GT(colored(deviation, 0.8, 1, -1), 1000) << "lower half";
  const Rgb paper = {255, 255, 255};
  EXPECT_EQ(deviation.at(1, 1), paper);
}

TEST(FitPicture, PutsBothCurvaturesOfABallInBlueSideBySide) {
  const Image curvature = draw_fit(one_patch(), {ball_beside_its_mesh()})[1].image;
  EXPECT_EQ(curvature.width, 1170);
  for (const double from : {0.0, 0.45}) {
    EXPECT_GT(colored(curvature, from, from + 0.43, -1), 40000);
    EXPECT_EQ(colored(curvature, from, from + 0.43, 1), 0);
  }
}

// A half pipe of radius 20 about z, like a condyle: 150 degrees do not fit into one view.
TEST(FitPicture, ShowsWhatTurnsFarFromTwoSides) {
  const TriangleMesh pipe = test::grid_sheet(60, 30, [](double i, double j) {
    const double angle = (i / 60 - 0.5) * 150 * M_PI / 180;
    return Vector3d(20 * std::sin(angle), -20 * std::cos(angle), 20 * (0.5 - j / 30));
  });
  const FittedSurface surface = fitted(pipe, [](const Vector3d& p) {
    return Eigen::Vector2d(20 * std::atan2(p.x(), -p.y()), -p.z());
  });
  const auto pictures = draw_fit(one_patch(), {surface});
  EXPECT_EQ(pictures[0].image.width, 1170);
  EXPECT_EQ(pictures[1].image.height, 1160) << "the curvatures below each other";
}

// A name may have 100 characters of four bytes each, the name of a file has 255 bytes.
TEST(FitPicture, HasNamesThatFilesMayHave) {
  Scene scene = one_patch();
  scene.surfaces.push_back(scene.surfaces[0]);
  FittedSurface one = ball_beside_its_mesh(), other = one;
  one.report->surface.clear();
  for (int i = 0; i < 100; ++i) one.report->surface += "\U0001D538";
  other.report->surface = one.report->surface;
  other.report->surface.back() = '\xB9';
  std::set<std::string> names;
  for (const FitPicture& picture : draw_fit(scene, {one, other})) {
    names.insert(picture.name);
    EXPECT_LT(picture.name.size(), 200u);
  }
  EXPECT_EQ(names.size(), 4u);
}

TEST(FitPicture, LeavesExactSurfacesOut) {
  EXPECT_TRUE(draw_fit(one_patch(), {FittedSurface{}}).empty());
}

}  // namespace
}  // namespace condyle
