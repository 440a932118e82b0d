#include "condyle/pictures/pressure_map.h"

#include <gtest/gtest.h>

#include <cmath>

#include "condyle/pictures/color_map.h"
#include "condyle/pictures/knee_shapes.h"
#include "support/block_knee.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

constexpr double kLayeredRadius = 30, kDepth = 0.5;  // of a ball in a plane [mm]
// E (1 - ν)/((1 + ν)(1 - 2ν))/h at E = 10 N/mm², ν = 0.45, both layers 6 mm [N/mm³].
constexpr double kStiffness = 6.321839080459770;

/// A layered ball 0.5 mm deep in a layered plane.
Run ball_in_plane(double greatest = 0) {
  Run run = ball_over_plane(kLayeredRadius, -kDepth);
  for (SurfaceDescription& surface : run.scene.surfaces)
    surface.elastic = ElasticSurface{.modulus = 10, .poisson = 0.45, .layer = 3};
  run.scene.contacts.resize(1);
  run.scene.contacts[0].layer.emplace();
  for (PoseResult& pose : run.sweep.poses) {
    pose.contacts.resize(1);
    pose.contacts[0].layer.emplace().peak_pressure = greatest;
  }
  return run;
}

const std::vector<RigidTransform> kAsBuilt(2);

TEST(PressureMap, IsTheLawAtTheDepthOfThePoint) {
  const auto run = ball_in_plane();
  const PressureMap map(run);
  for (const double r : {0.0, 2.0, 5.0}) {
    const double depth = kLayeredRadius - std::hypot(r, kLayeredRadius - kDepth);
    EXPECT_NEAR(map.pressure(1, {r, 0, 0}, {0, 1, 0}, kAsBuilt).value(), kStiffness * depth, 1e-9);
  }
  EXPECT_EQ(map.pressure(1, {20, 0, 0}, {0, 1, 0}, kAsBuilt).value(), 0) << "not pressed";
  const Vector3d top(0, 2 * kLayeredRadius - kDepth, 0);
  EXPECT_FALSE(map.pressure(0, top, {0, 1, 0}, kAsBuilt)) << "looks away from the plane";
}

TEST(PressureMap, ARigidContactHasNone) {
  auto run = ball_in_plane();
  run.scene.contacts[0].layer.reset();
  EXPECT_FALSE(PressureMap(run).pressure(1, {0, 0, 0}, {0, 1, 0}, kAsBuilt));
}

TEST(PressureMap, OneScaleForAllPosesEndsAtARoundNumber) {
  EXPECT_EQ(greatest_pressure(ball_in_plane(3.2)), 3.2);
  const auto run = ball_in_plane(3.2);
  EXPECT_GE(PressureMap(run).top(), 3.2);
  EXPECT_LE(PressureMap(run).top(), 6.4);
}

/// The plane as a grid of triangles.
ShadedMesh grid(double reach, int n) {
  ShadedMesh mesh;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j)
      mesh.vertices.push_back({Eigen::Vector3f(static_cast<float>(reach * (2.0 * i / n - 1)), 0,
                                               static_cast<float>(reach * (2.0 * j / n - 1))),
                               {0, 1, 0},
                               {}});
  const auto at = [n](int i, int j) { return static_cast<std::uint32_t>(i * (n + 1) + j); };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      mesh.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j)});
      mesh.triangles.push_back({at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)});
    }
  return mesh;
}

TEST(PressureMap, OutlinesTheAreaAndColoursWhatIsPressed) {
  const auto run = ball_in_plane(3.2);
  ShadedMesh mesh = grid(12, 60);
  const double line = 0.05;
  const ShadedMesh outline = PressureMap(run).paint(mesh, 1, kAsBuilt, kCartilage, line);
  // The ball cuts the plane in a circle.
  const double radius = std::sqrt(kLayeredRadius * kLayeredRadius -
                                  (kLayeredRadius - kDepth) * (kLayeredRadius - kDepth));
  ASSERT_FALSE(outline.vertices.empty());
  for (const ShadedVertex& vertex : outline.vertices)
    EXPECT_NEAR(vertex.position.head<3>().norm(), radius, line + 0.02);
  for (const ShadedVertex& vertex : mesh.vertices) {
    const bool plain = vertex.color[0] == kCartilage.color[0] &&
                       vertex.color[1] == kCartilage.color[1] &&
                       vertex.color[2] == kCartilage.color[2];
    EXPECT_EQ(plain, vertex.position.norm() >= static_cast<float>(radius))
        << vertex.position.norm();
  }
}

}  // namespace
}  // namespace condyle
