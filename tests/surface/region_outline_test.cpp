/// The outline of a region, whichever of its triangles stands first.

#include "condyle/surface/region_outline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <set>

namespace condyle {
namespace {

/// A square of `n` by `n` cells of 1 mm, without those triangles that one vertex has, with the
/// triangles of the plane in an order of `seed` and its vertices numbered by it.
TriangleMesh square_without(int n, int i, int j, unsigned seed) {
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
    if (a != at(i, j) && b != at(i, j) && c != at(i, j)) mesh.triangles.push_back({a, b, c});
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

// The hole about (1, 1) shares the corner (0, 0) with the outer edge.
TEST(RegionOutline, AHoleThatTouchesTheEdgeIsOneInAnyOrder) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const TriangleMesh mesh = square_without(8, 1, 1, seed);
    const RegionOutline outline = trace_outline(mesh, 12);
    EXPECT_EQ(outline.holes, 1) << seed;
    EXPECT_EQ(outline.hole_fans.size(), 4U) << seed;
    EXPECT_EQ(outline.edges.size(), 32U) << seed;
    EXPECT_EQ(edges_of(mesh, outline),
              edges_of(mesh, trace_outline(square_without(8, 4, 4, seed), 12)))
        << seed;
  }
}

}  // namespace
}  // namespace condyle
