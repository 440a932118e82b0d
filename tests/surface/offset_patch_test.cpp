/// Patches moved along their normal: a ball grows, a socket shrinks, and a fold is refused.

#include "condyle/surface/offset_patch.h"

#include <gtest/gtest.h>

#include <cmath>

#include "condyle/input_error.h"
#include "condyle/mesh/mesh_measures.h"
#include "support/mesh_shapes.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

constexpr double kBallRadius = 25;

/// A square of 30 mm of a ball of 25 mm: its outside, or the inside of a socket.
ArticularRegion ball_region(bool socket) {
  const TriangleMesh mesh = test::height_sheet(30, 60, [](double x, double y) {
    return std::sqrt(kBallRadius * kBallRadius - x * x - y * y);
  });
  ArticularRegion region;
  for (const Vector3d& n : vertex_normals(mesh)) region.normals.push_back(socket ? -n : n);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    region.chart.emplace_back(mesh.vertices[i].head<2>());
    region.slope.push_back(std::abs(region.normals[i].z()));
  }
  region.mesh = mesh;
  return region;
}

void expect_radius(bool socket, double offset, double radius) {
  const ArticularRegion region = ball_region(socket);
  const PatchFit fit = fit_patch(region, {.smoothing_length = 0.3});
  const OffsetPatch moved = offset_patch(region, fit, offset);
  EXPECT_LT(moved.max, 2e-4);
  const Patch patch(moved.patch), before(fit.patch);
  const double bend = socket ? 1 : -1;
  for (const Place& place : patch.samples(1.5)) {
    const SurfacePoint at = patch.evaluate(place), old = before.evaluate(place);
    EXPECT_NEAR(at.c.norm(), radius, 0.02);
    EXPECT_GT(at.n.dot(old.n), 1 - 1e-5);
    EXPECT_GT(at.n.dot(at.c) * -bend, 0);
    if (before.edge_distance(place) > 3) {
      EXPECT_NEAR(at.K.trace(), 2 * bend / radius, 2e-3);
    }
    // The same part is known, seen from the centre.
    EXPECT_GT(before.edge_distance(place), -0.2);
  }
  const Place middle = Patch::place(0, 0);
  EXPECT_NEAR(patch.edge_distance(middle), before.edge_distance(middle) * radius / kBallRadius,
              0.3);
  for (const Vector3d& p : moved.region.vertices) EXPECT_NEAR(p.norm(), radius, 0.02);
}

TEST(OffsetPatch, OfABallIsALargerBall) { expect_radius(false, 2.5, kBallRadius + 2.5); }
TEST(OffsetPatch, OfASocketIsASmallerSocket) { expect_radius(true, 2.5, kBallRadius - 2.5); }

TEST(OffsetPatch, IsRefusedWhereItWouldFoldOver) {
  const ArticularRegion region = ball_region(true);
  const PatchFit fit = fit_patch(region, {.smoothing_length = 0.3});
  EXPECT_NO_THROW((void)offset_patch(region, fit, 20));
  try {
    (void)offset_patch(region, fit, 26);
    FAIL() << "26 mm in a socket of 25 mm";
  } catch (const InputError& error) {
    EXPECT_NE(
        std::string(error.what()).find("offset of 26 mm, expected less than the least radius"),
        std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace condyle
