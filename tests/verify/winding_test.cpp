#include "condyle/verify/winding.h"

#include <gtest/gtest.h>

#include <cmath>

namespace condyle::verification {
namespace {

/// A ball of radius 10 as a mesh of rings.
TriangleMesh ball() {
  constexpr int kRings = 40, kRound = 60;
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 10}, {0, 0, -10}};
  for (int i = 1; i < kRings; ++i)
    for (int j = 0; j < kRound; ++j) {
      const double a = M_PI * i / kRings, b = 2 * M_PI * j / kRound;
      mesh.vertices.emplace_back(10 * std::sin(a) * std::cos(b), 10 * std::sin(a) * std::sin(b),
                                 10 * std::cos(a));
    }
  const auto at = [](int ring, int j) {
    if (ring == 0) return 0;
    if (ring == kRings) return 1;
    return 2 + (ring - 1) * kRound + j % kRound;
  };
  for (int i = 0; i < kRings; ++i)
    for (int j = 0; j < kRound; ++j) {
      if (i > 0) mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
      if (i + 1 < kRings) mesh.triangles.push_back({at(i, j + 1), at(i + 1, j), at(i + 1, j + 1)});
    }
  return mesh;
}

TEST(Winding, TellsInsideFromOutside) {
  const TriangleMesh mesh = ball();
  const Winding winding(mesh);
  EXPECT_TRUE(winding.closed());
  for (double x = -15; x <= 15; x += 0.93)
    for (double y = -15; y <= 15; y += 1.7) {
      const Eigen::Vector3d p(x, y, 1.3);
      if (std::abs(p.norm() - 10) < 0.1) continue;  // the mesh is no exact ball
      EXPECT_NEAR(winding.number(p), p.norm() < 10 ? 1 : 0, 0.05) << p.transpose();
      EXPECT_NEAR(winding.distance(p), std::abs(p.norm() - 10), 0.06);
    }
}

TEST(Winding, KnowsASheetFromASolid) {
  TriangleMesh sheet;
  sheet.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  sheet.triangles = {{0, 1, 2}, {1, 3, 2}};
  EXPECT_FALSE(Winding(sheet).closed());
}

}  // namespace
}  // namespace condyle::verification
