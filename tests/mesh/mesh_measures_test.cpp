#include "mesh/mesh_measures.h"

#include <gtest/gtest.h>

#include <numeric>

#include "mesh/mesh_shapes.h"

namespace condyle {
namespace {

using Eigen::Vector3d;
using namespace testing;

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
