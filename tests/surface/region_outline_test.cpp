/// The outline of a region, whichever of its triangles stands first.

#include "condyle/surface/region_outline.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <set>

namespace condyle {
namespace {

/// A square of 8 by 8 mm with a hole about (2, 2), with its triangles in an order of `seed` and its
/// vertices numbered by it. The hole may reach the edge at (0, 1).
TriangleMesh square_with_hole(bool touches_edge, unsigned seed) {
  constexpr int n = 8;
  std::mt19937 random(seed);
  const int count = (n + 1) * (n + 1);
  std::vector<int> number(static_cast<std::size_t>(count));
  std::iota(number.begin(), number.end(), 0);
  if (seed > 0) std::shuffle(number.begin(), number.end(), random);
  const auto at = [&](int x, int y) { return number[static_cast<std::size_t>(x * (n + 1) + y)]; };
  TriangleMesh mesh;
  mesh.vertices.resize(number.size());
  for (int x = 0; x <= n; ++x)
    for (int y = 0; y <= n; ++y)
      mesh.vertices[static_cast<std::size_t>(at(x, y))] = Eigen::Vector3d(x, y, 0);
  const auto add = [&](int a, int b, int c) {
    const int hub = at(2, 2);
    const bool reaches = touches_edge && a == at(0, 1) && b == at(1, 1) && c == at(1, 2);
    if (a != hub && b != hub && c != hub && !reaches) mesh.triangles.push_back({a, b, c});
  };
  for (int x = 0; x < n; ++x)
    for (int y = 0; y < n; ++y) {
      add(at(x, y), at(x + 1, y), at(x + 1, y + 1));
      add(at(x, y), at(x + 1, y + 1), at(x, y + 1));
    }
  std::shuffle(mesh.triangles.begin(), mesh.triangles.end(), random);
  return mesh;
}

/// The edges by their ends in the plane.
std::set<std::array<double, 4>> edges_of(const TriangleMesh& mesh, const RegionOutline& outline) {
  std::set<std::array<double, 4>> edges;
  for (const auto& [a, b] : outline.edges) {
    const Eigen::Vector3d &p = mesh.vertices[static_cast<std::size_t>(a)],
                          &q = mesh.vertices[static_cast<std::size_t>(b)];
    edges.insert({p.x(), p.y(), q.x(), q.y()});
  }
  return edges;
}

TEST(RegionOutline, AHoleThatTouchesTheEdgeIsOneInAnyOrder) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    const TriangleMesh mesh = square_with_hole(true, seed), within = square_with_hole(false, seed);
    const RegionOutline outline = trace_outline(mesh, 12);
    EXPECT_EQ(outline.holes, 1) << seed;
    EXPECT_EQ(outline.hole_fans.size(), 5U) << seed;
    EXPECT_EQ(outline.edges.size(), 32U) << seed;
    EXPECT_EQ(edges_of(mesh, outline), edges_of(within, trace_outline(within, 12))) << seed;
  }
}

// A triangle at the rim that faces the other way cuts the outline into chains with ends, of which none is a hole; the
// hole is still one.
TEST(RegionOutline, APieceOfTheRimIsNoHole) {
  for (const double small_hole : {0.1, 12.0})
    for (int side = 0; side < 4; ++side)
      for (unsigned seed = 0; seed < 10; ++seed) {
        SCOPED_TRACE(fmt::format("{}, {}, {}", small_hole, side, seed));
        TriangleMesh mesh = square_with_hole(false, seed);
        const RegionOutline expected = trace_outline(mesh, small_hole);
        const std::array<Eigen::Vector3d, 4> from = {{{0, 4, 0}, {4, 0, 0}, {8, 3, 0}, {4, 8, 0}}},
                                             to = {{{0, 3, 0}, {5, 0, 0}, {8, 4, 0}, {3, 8, 0}}};
        const auto number = [&](const Eigen::Vector3d& p) {
          return static_cast<int>(std::find(mesh.vertices.begin(), mesh.vertices.end(), p) -
                                  mesh.vertices.begin());
        };
        const auto k = static_cast<std::size_t>(side);
        const int a = number(from[k]), b = number(to[k]);
        mesh.triangles.push_back({a, b, static_cast<int>(mesh.vertices.size())});
        mesh.vertices.emplace_back(4, 4, 9);
        const RegionOutline outline = trace_outline(mesh, small_hole);
        EXPECT_EQ(outline.wide_holes.count, expected.wide_holes.count);
        EXPECT_EQ(outline.holes, expected.holes);
        EXPECT_EQ(outline.edges.size(), expected.edges.size() + 1);
      }
}

}  // namespace
}  // namespace condyle
