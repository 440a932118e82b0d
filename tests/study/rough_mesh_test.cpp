#include "condyle/study/rough_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "condyle/math/rotation.h"
#include "condyle/mesh/mesh_measures.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/specimen/fit_surfaces.h"
#include "condyle/surface/patch.h"
#include "support/mesh_shapes.h"
#include "support/moved_scene.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

/// A ball of 25 mm without its poles, facing out, about `middle`.
TriangleMesh ball(const Vector3d& middle = Vector3d::Zero()) {
  constexpr int kAlong = 100, kAround = 240;
  return test::grid_sheet(kAlong, kAround, [&](double i, double j) {
    const double latitude = (i / kAlong - 0.5) * 2, longitude = 2 * std::numbers::pi * j / kAround;
    return Vector3d(middle + 25 * Vector3d(std::cos(latitude) * std::cos(longitude),
                                           std::cos(latitude) * std::sin(longitude),
                                           std::sin(latitude)));
  });
}

double rms(const std::vector<double>& values) {
  double squares = 0;
  for (const double v : values) squares += v * v;
  return std::sqrt(squares / static_cast<double>(values.size()));
}

/// Over points and over fields of 20 seeds, so that chance leaves a hundredth.
TEST(RoughMesh, FieldHasTheStrengthAndTheCorrelationThatAreAskedFor) {
  const TriangleMesh mesh = ball();
  constexpr double kRms = 0.3, kLength = 1.5;
  const std::vector<double> lags = {0, 0.75, 1.5, 3, 6};
  std::vector<double> products(lags.size(), 0);
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    for (std::size_t lag = 0; lag < lags.size(); ++lag) {
      // Pairs about the axis, a chord of the lag apart.
      std::vector<Vector3d> here, there;
      for (std::size_t i = 0; i < mesh.vertices.size(); i += 7) {
        const Vector3d& p = mesh.vertices[i];
        const double turn = 2 * std::asin(lags[lag] / 2 / p.head<2>().norm());
        here.push_back(p);
        there.emplace_back(std::cos(turn) * p.x() - std::sin(turn) * p.y(),
                           std::sin(turn) * p.x() + std::cos(turn) * p.y(), p.z());
      }
      const MeshRoughness roughness{kRms, kLength, seed};
      const auto a = roughness_field(here, {}, roughness),
                 b = roughness_field(there, {}, roughness);
      for (std::size_t i = 0; i < a.size(); ++i)
        products[lag] += a[i] * b[i] / (20 * static_cast<double>(a.size()));
    }
  for (std::size_t lag = 0; lag < lags.size(); ++lag) {
    const double d = lags[lag];
    EXPECT_NEAR(products[lag] / (kRms * kRms), std::exp(-d * d / (2 * kLength * kLength)), 0.03)
        << d << " mm";
  }
}

TEST(RoughMesh, VerticesMoveAlongTheNormalsOfTheMesh) {
  const TriangleMesh smooth = ball();
  TriangleMesh rough = smooth;
  roughen(rough, {0.2, 1.5, 3});
  const std::vector<Vector3d> normals = vertex_normals(smooth);
  std::vector<double> height;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const Vector3d moved = rough.vertices[i] - smooth.vertices[i];
    height.push_back(moved.dot(normals[i]));
    EXPECT_NEAR(moved.cross(normals[i]).norm(), 0, 1e-12);
  }
  EXPECT_NEAR(rms(height), 0.2, 0.02);
  EXPECT_EQ(rough.triangles, smooth.triangles);
}

TEST(RoughMesh, OneSeedIsOneFieldAndAnotherMeshHasAnother) {
  const std::vector<Vector3d> points = ball().vertices;
  const auto field = [&](std::uint64_t seed, std::uint64_t mesh) {
    return roughness_field(points, {}, {0.2, 1.5, seed}, mesh);
  };
  const std::vector<double> first = field(1, 0);
  EXPECT_EQ(first, field(1, 0));
  const std::vector<double> others[] = {field(2, 0), field(1, 1), field(std::uint64_t(1) << 52, 0)};
  for (const std::vector<double>& other : others) {
    double product = 0;
    for (std::size_t i = 0; i < points.size(); ++i) product += first[i] * other[i];
    EXPECT_LT(std::abs(product) / static_cast<double>(points.size()) / (0.2 * 0.2), 0.1);
  }
}

/// What there is to a point does not depend on the points beside it.
TEST(RoughMesh, PartOfTheVerticesMoveAsTheyDoAmongAll) {
  TriangleMesh all = ball(), part = all;
  const TriangleMesh before = all;
  roughen(all, {0.2, 1.5, 9}, 1);
  roughen(part, {0.2, 1.5, 9}, 1, {3, 500, 700});
  for (const int i : {3, 500, 700}) EXPECT_EQ(part.vertices[i], all.vertices[i]);
  EXPECT_EQ(part.vertices[4], before.vertices[4]);
}

TEST(RoughMesh, DoesNotAskWhereTheFileHasItsOrigin) {
  const Vector3d elsewhere(310.3, -47.1, 1200.9);
  TriangleMesh here = ball(), there = ball(elsewhere);
  roughen(here, {0.2, 1.5, 3});
  roughen(there, {0.2, 1.5, 3});
  for (std::size_t i = 0; i < here.vertices.size(); ++i)
    EXPECT_NEAR((there.vertices[i] - elsewhere - here.vertices[i]).norm(), 0, 1e-10);
}

double greatest_distance(const FittedSurface& a, const FittedSurface& b) {
  double greatest = 0;
  for (const Place& place : a.surface->samples(3)) {
    const Vector3d c = a.surface->evaluate(place).c;
    greatest = std::max(
        greatest, (b.surface->evaluate(b.surface->closest(c, b.surface->seed(c))).c - c).norm());
  }
  return greatest;
}

class RoughPhantom : public ::testing::Test {
 protected:
  const Scene scene = read_scene(CONDYLE_SOURCE_DIR "/data/phantom/knee.toml");
  const std::vector<FittedSurface> surfaces = fit_surfaces(scene);
};

TEST_F(RoughPhantom, WithoutRoughnessIsThePhantom) {
  const auto same = roughened_surfaces(scene, surfaces, {0, 1.5, 1});
  for (std::size_t i = 0; i < same.size(); ++i)
    EXPECT_LT(greatest_distance(surfaces[i], same[i]), 1e-6);
}

TEST_F(RoughPhantom, IsFittedToItsRoughnessAndTheSameForTheSameSeed) {
  const MeshRoughness roughness{0.2, 1.5, 5};
  const std::vector<FittedMesh> meshes = fitted_meshes(scene, surfaces);
  ASSERT_EQ(meshes.size(), 2u);
  const auto once = roughened_surfaces(scene, surfaces, meshes, roughness),
             again = roughened_surfaces(scene, surfaces, roughness);
  for (std::size_t i = 0; i < once.size(); ++i) {
    SCOPED_TRACE(scene.surfaces[i].name);
    EXPECT_EQ(dynamic_cast<const Patch&>(*once[i].surface).data().control_points,
              dynamic_cast<const Patch&>(*again[i].surface).data().control_points);
    // On top of 0.2 mm that the phantom has: what is left beside the patch is √2 as much.
    EXPECT_NEAR(once[i].report->core_rms / surfaces[i].report->core_rms, std::sqrt(2.), 0.25);
    EXPECT_GT(greatest_distance(surfaces[i], once[i]), 0.05);
    EXPECT_EQ(once[i].bone, surfaces[i].bone);
  }
}

TEST_F(RoughPhantom, MovesAndTurnsWithItsFrame) {
  const test::MovedScene moved(
      scene, {RigidTransform{exp_rotation({0.3, -1.1, 0.4}), {120.3, -44.7, 803.1}},
              RigidTransform{exp_rotation({-0.9, 0.2, 2.1}), {7.1, 9.9, -250.4}}});
  const std::vector<FittedSurface> there = fit_surfaces(moved.scene(), {}, moved.mesh_reader());
  const MeshRoughness roughness{0.2, 1.5, 5};
  const auto expected = moved.surfaces(roughened_surfaces(scene, surfaces, roughness)),
             actual = roughened_surfaces(moved.scene(), there, roughness);
  for (std::size_t i = 0; i < actual.size(); ++i)
    EXPECT_LT(greatest_distance(expected[i], actual[i]), 1e-5);
}

TEST_F(RoughPhantom, IsTheSameInWhateverOrderItsSurfacesStand) {
  Scene other = scene;
  std::reverse(other.surfaces.begin(), other.surfaces.end());
  std::vector<FittedSurface> reversed(surfaces.rbegin(), surfaces.rend());
  const MeshRoughness roughness{0.2, 1.5, 5};
  const auto once = roughened_surfaces(scene, surfaces, roughness),
             again = roughened_surfaces(other, reversed, roughness);
  for (std::size_t i = 0; i < once.size(); ++i)
    EXPECT_EQ(dynamic_cast<const Patch&>(*once[i].surface).data().control_points,
              dynamic_cast<const Patch&>(*again[once.size() - 1 - i].surface).data().control_points)
        << scene.surfaces[i].name;
}

}  // namespace
}  // namespace condyle
