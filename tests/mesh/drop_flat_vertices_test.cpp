#include "condyle/mesh/drop_flat_vertices.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>

#include "condyle/mesh/mesh_measures.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

/// A sheet of n x n squares of 1 mm, two triangles each.
template <class Height>
TriangleMesh sheet(int n, Height height) {
  TriangleMesh mesh;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) mesh.vertices.emplace_back(i, j, height(i, j));
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const int a = i * (n + 1) + j, b = a + n + 1;
      mesh.triangles.push_back({a, b, b + 1});
      mesh.triangles.push_back({a, b + 1, a + 1});
    }
  return mesh;
}
double bumpy(int i, int j) {
  return 0.3 * std::sin(1.7 * i + 0.4 * j * j) + 0.2 * std::cos(2.3 * j);
}

/// Each triangle cut into four at the middles of its edges.
TriangleMesh split(TriangleMesh mesh) {
  std::map<std::pair<int, int>, int> middles;
  const auto middle = [&](int a, int b) {
    const auto [found, added] =
        middles.try_emplace(std::minmax({a, b}), static_cast<int>(mesh.vertices.size()));
    if (added) {
      const Vector3d half = (mesh.vertices[a] + mesh.vertices[b]) / 2;
      mesh.vertices.push_back(half);
    }
    return found->second;
  };
  std::vector<std::array<int, 3>> fine;
  for (const auto& [a, b, c] : mesh.triangles) {
    const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    for (const auto& part : {std::array{a, ab, ca}, std::array{ab, b, bc}, std::array{ca, bc, c},
                             std::array{ab, bc, ca}})
      fine.push_back(part);
  }
  mesh.triangles = std::move(fine);
  return mesh;
}

/// Each from its least corner on, in order.
std::vector<std::array<int, 3>> sorted(std::vector<std::array<int, 3>> triangles) {
  for (auto& t : triangles) std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

double area(const TriangleMesh& mesh) {
  double sum = 0;
  for (const Vector3d& a : triangle_areas(mesh)) sum += a.norm();
  return sum;
}

TEST(DropFlatVertices, GivesASplitMeshBackAsItWas) {
  const TriangleMesh mesh = sheet(12, bumpy);
  TriangleMesh fine = split(split(split(mesh)));
  ASSERT_EQ(fine.triangles.size(), 64 * mesh.triangles.size());
  for (Vector3d& p : fine.vertices) p = p.cast<float>().cast<double>();
  const TriangleMesh back = drop_flat_vertices(fine);
  ASSERT_EQ(back.vertices.size(), mesh.vertices.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    EXPECT_LT((back.vertices[i] - mesh.vertices[i]).norm(), 1e-5);
  EXPECT_EQ(sorted(back.triangles), sorted(mesh.triangles));
}

TEST(DropFlatVertices, LeavesAMeshAloneWhoseVerticesAllTellSomething) {
  const TriangleMesh mesh = sheet(12, bumpy);
  const TriangleMesh same = drop_flat_vertices(mesh);
  EXPECT_EQ(same.triangles, mesh.triangles);
  // A ball of 25 mm meshed as finely as scans are: a sagitta of 1e-3 mm and more.
  const auto ball = [](int i, int j) {
    const double x = 0.4 * (i - 10), y = 0.4 * (j - 10);
    return std::sqrt(625 - x * x - y * y);
  };
  TriangleMesh fine = sheet(20, ball);
  for (Vector3d& p : fine.vertices) p.head<2>() *= 0.4;
  EXPECT_EQ(drop_flat_vertices(fine).vertices.size(), fine.vertices.size());
}

/// Triangles by the places of their corners, whatever those are called.
std::vector<std::array<std::array<double, 3>, 3>> places(const TriangleMesh& mesh) {
  std::vector<std::array<std::array<double, 3>, 3>> found;
  for (const auto& t : mesh.triangles) {
    auto& corners = found.emplace_back();
    for (std::size_t k = 0; k < 3; ++k)
      corners[k] = {mesh.vertices[t[k]].x(), mesh.vertices[t[k]].y(), mesh.vertices[t[k]].z()};
    std::sort(corners.begin(), corners.end());
  }
  std::sort(found.begin(), found.end());
  return found;
}

// Uneven and flat in places: which vertices go, and onto which, is a matter of the shape alone.
TEST(DropFlatVertices, DoesNotDependOnTheOrderOfAFile) {
  TriangleMesh mesh = sheet(24, [](int i, int j) { return i < 12 ? 0.0 : bumpy(i, j); });
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const double s = static_cast<double>(v);
    mesh.vertices[v] += 0.2 * Vector3d(std::sin(12.9898 * s), std::sin(78.233 * s), 0);
  }
  const TriangleMesh rest = drop_flat_vertices(mesh);
  ASSERT_LT(rest.vertices.size(), mesh.vertices.size());
  TriangleMesh turned = mesh;
  for (auto& t : turned.triangles) std::rotate(t.begin(), t.begin() + 1, t.end());
  EXPECT_EQ(places(drop_flat_vertices(turned)), places(rest));
  TriangleMesh backwards = mesh;
  std::reverse(backwards.vertices.begin(), backwards.vertices.end());
  std::reverse(backwards.triangles.begin(), backwards.triangles.end());
  const int last = static_cast<int>(mesh.vertices.size()) - 1;
  for (auto& t : backwards.triangles)
    for (int& v : t) v = last - v;
  EXPECT_EQ(places(drop_flat_vertices(backwards)), places(rest));
}

// A fit wants points on planes too: no edge grows longer than what a patch resolves, and the sheet
// stays the sheet.
TEST(DropFlatVertices, LeavesPlanesSampled) {
  const TriangleMesh plane = split(sheet(12, [](int, int) { return 0.0; }));
  const TriangleMesh rest = drop_flat_vertices(plane);
  EXPECT_LT(rest.vertices.size(), plane.vertices.size() / 2);
  EXPECT_NEAR(area(rest), 144, 1e-9);
  for (const auto& t : rest.triangles)
    for (int k = 0; k < 3; ++k)
      EXPECT_LE((rest.vertices[t[k]] - rest.vertices[t[(k + 1) % 3]]).norm(), 3 + 1e-12);
}

}  // namespace
}  // namespace condyle
