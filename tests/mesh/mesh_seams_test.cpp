/// Seams are found, and both sides linked, whatever vertices either has.

#include "condyle/mesh/mesh_seams.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "condyle/mesh/clean_mesh.h"
#include "condyle/mesh/merge_vertices.h"
#include "condyle/mesh/mesh_measures.h"
#include "condyle/mesh/weld_seams.h"

namespace condyle {
namespace {

/// Squares of a side, two triangles each, from (x, y) on.
void add_squares(double x, double y, double side, int columns, int rows, TriangleMesh& mesh) {
  for (int i = 0; i < columns; ++i)
    for (int k = 0; k < rows; ++k) {
      const int first = static_cast<int>(mesh.vertices.size());
      for (const auto& [u, v] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}})
        mesh.vertices.emplace_back(x + (i + u) * side, y + (k + v) * side, 0);
      mesh.triangles.push_back({first, first + 1, first + 2});
      mesh.triangles.push_back({first, first + 2, first + 3});
    }
}

double area_of(const TriangleMesh& mesh) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& triangle : mesh.triangles) sum += triangle_area(mesh, triangle);
  return sum.norm();
}

/// Squares of 1 mm up to x = 0, of another side beyond a gap.
TriangleMesh two_sheets(double side, double gap) {
  TriangleMesh mesh;
  add_squares(-10, 0, 1, 10, 10, mesh);
  const int columns = static_cast<int>(std::lround(10 / side));
  add_squares(gap, 0, side, columns, columns, mesh);
  merge_vertices(mesh, 1e-6);
  return mesh;
}

const std::pair<double, double> kSheets[] = {{1, 0.02},  {1, 0.2},    {0.5, 0}, {0.5, 0.05},
                                             {0.4, 0},   {0.4, 0.08}, {2.0, 0}, {5.0, 0.02},
                                             {0.125, 0}, {2.5, 0.02}};

TEST(MeshSeams, AreAsLongAsTheyLook) {
  EXPECT_EQ(find_seams({}).length, 0);
  EXPECT_EQ(find_seams(two_sheets(1, 0)).length, 0) << "both sides have the same vertices";
  EXPECT_EQ(find_seams(two_sheets(0.5, 1)).length, 0) << "a gap as wide as the triangles";
  for (const auto& [side, gap] : kSheets)
    EXPECT_NEAR(find_seams(two_sheets(side, gap)).length, 10, 1) << side << ", " << gap;
}

TEST(MeshSeams, AreWelded) {
  for (const auto& [side, gap] : kSheets) {
    TriangleMesh mesh = two_sheets(side, gap);
    const double area = area_of(mesh);
    const WeldedSeams welded = weld_seams(mesh);
    EXPECT_NEAR(welded.length, 10, 1);
    EXPECT_EQ(welded.joined, welded.length);
    EXPECT_NEAR(area_of(mesh), area, 10 * gap + 1e-9) << side << ", " << gap;
    EXPECT_EQ(find_seams(mesh).length, 0) << side << ", " << gap;
    const CleanMesh clean = clean_mesh(mesh);
    EXPECT_EQ(clean.report.components, 1) << side << ", " << gap;
    EXPECT_EQ(clean.report.non_manifold_edges, 0) << side << ", " << gap;
    // All the way: the boundary is the outline of both sheets.
    const int outline = 30 + 3 * static_cast<int>(std::lround(10 / side));
    EXPECT_EQ(clean.report.boundary_edges, outline) << side << ", " << gap;
  }
}

// Ten thousand needles of 100 mm through one another, each beside all others.
TEST(MeshSeams, TakeNoTimeWhateverLiesBesideWhat) {
  TriangleMesh mesh;
  for (int i = 0; i < 10000; ++i) {
    const double x = 1e-3 * i, y = i % 2 == 0 ? 0.01 : -0.01;
    const int first = static_cast<int>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), {{x, 0, 0}, {x + 100, 0, 1e-4 * i}, {x + 50, y, 0}});
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  const std::size_t before = mesh.triangles.size();
  (void)weld_seams(mesh);
  EXPECT_LE(mesh.triangles.size(), before + 12 * before);
}

// Outlines with notches, and ribbons narrower than their edges are long.
TEST(MeshSeams, LeaveNotchesAndRibbonsAlone) {
  TriangleMesh saw;
  for (int i = 0; i <= 20; ++i)
    saw.vertices.insert(saw.vertices.end(),
                        {{double(i), 0, 0}, {i + 0.5, 1.5, 0}, {double(i), -1, 0}});
  for (int i = 0; i < 20; ++i) {
    const int at = 3 * i;
    saw.triangles.push_back({at, at + 3, at + 1});
    saw.triangles.push_back({at, at + 2, at + 5});
    saw.triangles.push_back({at, at + 5, at + 3});
  }
  EXPECT_EQ(find_seams(saw).length, 0);
  TriangleMesh ribbon;
  for (int i = 0; i <= 8; ++i)
    ribbon.vertices.insert(ribbon.vertices.end(), {{5.0 * i, 0, 0}, {5.0 * i, 0.4, 0}});
  for (int i = 0; i < 8; ++i) {
    const int at = 2 * i;
    ribbon.triangles.push_back({at, at + 2, at + 3});
    ribbon.triangles.push_back({at, at + 3, at + 1});
  }
  EXPECT_EQ(find_seams(ribbon).length, 0);
  EXPECT_EQ(weld_seams(ribbon).length, 0);
  EXPECT_EQ(ribbon.triangles.size(), 16U);
}

TEST(MeshSeams, AreWeldedAlikeInAnyUnit) {
  TriangleMesh mesh = two_sheets(0.4, 0.08), large = mesh;
  for (Eigen::Vector3d& v : large.vertices) v *= 1024;
  weld_seams(mesh);
  weld_seams(large);
  ASSERT_EQ(large.triangles, mesh.triangles);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    EXPECT_LT((large.vertices[i] / 1024 - mesh.vertices[i]).norm(), 1e-12);
}

// The rims of both walls of a thin sheet and short slits stay as they are.
TEST(MeshSeams, AreNotSeenWhereThereAreNone) {
  TriangleMesh walls;
  add_squares(0, 0, 1, 10, 10, walls);
  const std::size_t upper = walls.vertices.size();
  add_squares(0, 0, 1, 10, 10, walls);
  for (std::size_t i = upper; i < walls.vertices.size(); ++i) walls.vertices[i].z() = 0.1;
  merge_vertices(walls, 1e-6);
  EXPECT_EQ(find_seams(walls).length, 0);
  TriangleMesh slit = two_sheets(1, 0);
  const std::size_t triangles = slit.triangles.size();
  slit.triangles.erase(slit.triangles.begin() + 40);
  EXPECT_EQ(weld_seams(slit).length, 0);
  EXPECT_EQ(slit.triangles.size(), triangles - 1);
}

}  // namespace
}  // namespace condyle
