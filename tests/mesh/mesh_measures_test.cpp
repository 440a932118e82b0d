#include "condyle/mesh/mesh_measures.h"

#include <gtest/gtest.h>

#include <numeric>

#include "support/mesh_shapes.h"

namespace condyle {
namespace {

using Eigen::Vector3d;
using namespace test;

// The vector areas of a closed surface cancel; the areas of a cube of side 10 add to 600.
TEST(MeshMeasures, AreasOfAClosedSurfaceCancelAsVectors) {
  const TriangleMesh mesh = cube(10, {3, -2, 7});
  Vector3d sum = Vector3d::Zero();
  for (const Vector3d& a : triangle_areas(mesh)) sum += a;
  EXPECT_LT(sum.norm(), 1e-12);
  const std::vector<double> areas = vertex_areas(mesh);
  EXPECT_NEAR(std::accumulate(areas.begin(), areas.end(), 0.0), 600, 1e-10);
}

TEST(MeshMeasures, NormalsOfACubeLeaveItsCentre) {
  const TriangleMesh mesh = cube(2, {-1, -1, -1});
  const std::vector<Vector3d> normals = vertex_normals(mesh);
  for (std::size_t i = 0; i < normals.size(); ++i) {
    EXPECT_NEAR(normals[i].norm(), 1, 1e-12);
    EXPECT_GT(normals[i].dot(mesh.vertices[i]), 1);
  }
}

// Euler: V - E + F = 2, so a cube of 8 vertices and 12 triangles has 18 edges.
TEST(MeshMeasures, FindsEveryEdgeOnceWithBothTriangles) {
  const std::vector<MeshEdge> edges = mesh_edges(cube(1));
  EXPECT_EQ(edges.size(), 18u);
  for (const MeshEdge& e : edges) {
    EXPECT_EQ(e.count, 2);
    EXPECT_NE(e.forward[0],
              e.forward[1]);  // neighbours run through a common edge in opposite directions
  }
}

// Each side of a cube's triangles has one neighbour, which has a side back to it.
TEST(TriangleLinks, RunBothWays) {
  TriangleMesh mesh = cube(1);
  std::swap(mesh.triangles[5][1], mesh.triangles[5][2]);
  const TriangleLinks links(mesh);
  for (int t = 0; t < 12; ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const int other = links.across(t, k);
      ASSERT_GE(other, 0);
      EXPECT_TRUE(links.across(other, 0) == t || links.across(other, 1) == t ||
                  links.across(other, 2) == t);
      EXPECT_EQ(links.agrees(t, k), (t == 5) == (other == 5));
    }
}

// A sheet of two triangles has four sides of its own; a fin on the fifth takes that from both.
TEST(TriangleLinks, TellRimsFromFins) {
  TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}},
                    {{0, 1, 2}, {0, 2, 3}}};
  const TriangleLinks sheet(mesh);
  EXPECT_EQ(sheet.across(0, 2), 1);
  EXPECT_TRUE(sheet.is_boundary(0, 0));
  EXPECT_EQ(sheet.boundary_edges(), 4);
  mesh.triangles.push_back({0, 2, 4});
  const TriangleLinks fin(mesh);
  EXPECT_EQ(fin.across(0, 2), -1);
  EXPECT_FALSE(fin.is_boundary(0, 2));
  EXPECT_EQ(fin.non_manifold_edges(), 1);
  EXPECT_EQ(fin.boundary_edges(), 6);
}

TEST(MeshMeasures, SubMeshKeepsOnlyWhatItNeeds) {
  const TriangleMesh mesh = cube(1);
  std::vector<bool> keep(12, false);
  keep[2] = keep[3] = true;  // the top
  const SubMesh top = sub_mesh(mesh, keep);
  ASSERT_EQ(top.mesh.vertices.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(top.mesh.vertices[i].z(), 1);
    EXPECT_EQ(top.mesh.vertices[i], mesh.vertices[top.old_index[i]]);
  }
}

// A square sheet of n cells: edges of length h, h and h√2 in equal numbers per triangle.
TEST(MeshMeasures, MeanEdgeLengthOfAGrid) {
  const TriangleMesh mesh = height_sheet(12, 6, [](double, double) { return 1; });
  EXPECT_NEAR(mean_edge_length(mesh), 2 * (2 + std::sqrt(2.0)) / 3, 1e-12);
}

}  // namespace
}  // namespace condyle
