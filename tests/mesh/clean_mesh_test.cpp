#include "condyle/mesh/clean_mesh.h"

#include <gtest/gtest.h>

#include <cmath>

#include "condyle/mesh/merge_vertices.h"
#include "condyle/mesh/mesh_measures.h"
#include "support/mesh_shapes.h"

namespace condyle {
namespace {

using Eigen::Vector3d;
using namespace test;

/// Every triangle with vertices of its own, as in an STL file.
TriangleMesh apart(const TriangleMesh& mesh) {
  TriangleMesh result;
  for (const auto& triangle : mesh.triangles) {
    const int first = static_cast<int>(result.vertices.size());
    for (const int v : triangle) result.vertices.push_back(mesh.vertices[v]);
    result.triangles.push_back({first, first + 1, first + 2});
  }
  return result;
}

// Surfaces of damaged results may have both.
TEST(MergeVertices, AVertexThatIsNoNumberIsNearNoneAndAnyMayLieFarAway) {
  const Vector3d none(std::nan(""), 0, 0), infinite(0, HUGE_VAL, 0), far(0, 0, 1e300);
  TriangleMesh mesh;
  mesh.vertices = {none, far, Vector3d::Zero(), none, far, infinite, Vector3d(0, 0, 1e-10)};
  mesh.triangles = {{0, 1, 2}, {3, 4, 6}, {5, 4, 6}};
  EXPECT_EQ(merge_vertices(mesh, 1e-9), 2);
  EXPECT_EQ(mesh.vertices.size(), 5u);
  const std::vector<std::array<int, 3>> expected = {{0, 1, 2}, {3, 1, 2}, {4, 1, 2}};
  EXPECT_EQ(mesh.triangles, expected);
}

// A cube has 8 vertices; 12 triangles with 3 each make 36.
TEST(CleanMesh, MergesTheVerticesOfATriangleSoup) {
  const CleanMesh clean = clean_mesh(apart(cube(10)));
  EXPECT_EQ(clean.mesh.vertices.size(), 8u);
  EXPECT_EQ(clean.report.merged_vertices, 28);
  EXPECT_EQ(clean.report.closed_components, 1);
  EXPECT_EQ(clean.report.boundary_edges, 0);
  EXPECT_TRUE(describe(clean.report).empty());
}

// The tolerance is 1e-6 of the diagonal: 1.7e-5 mm for a cube of 10 mm. What is farther leaves a seam of two edges, which
// is too short to be joined.
TEST(CleanMesh, MergesWhatIsCloserThanTheToleranceAndNothingElse) {
  TriangleMesh mesh = apart(cube(10));
  mesh.vertices[0] += Vector3d(1e-5, 0, 0);
  EXPECT_EQ(clean_mesh(mesh).mesh.vertices.size(), 8u);
  mesh.vertices[0] += Vector3d(1e-3, 0, 0);
  EXPECT_EQ(clean_mesh(mesh).mesh.vertices.size(), 9u);
}

TEST(CleanMesh, DropsDegenerateAndDuplicateTrianglesAndUnusedVertices) {
  TriangleMesh mesh = cube(10);
  mesh.triangles.push_back({0, 0, 1});  // repeated vertex
  mesh.vertices.push_back({5, 0, 0});   // on the edge 0-1
  mesh.triangles.push_back({0, 8, 1});  // no area
  mesh.triangles.push_back({3, 2, 0});  // a triangle of the cube, the other way round
  mesh.vertices.push_back({3, 3, 3});   // nobody's
  const CleanMesh clean = clean_mesh(mesh);
  EXPECT_EQ(clean.report.degenerate_triangles, 2);
  EXPECT_EQ(clean.report.duplicate_triangles, 1);
  EXPECT_EQ(clean.report.unreferenced_vertices, 2);
  EXPECT_EQ(clean.mesh.triangles.size(), 12u);
  EXPECT_EQ(describe(clean.report).size(), 2u);
}

TEST(CleanMesh, TurnsAClosedSurfaceOutward) {
  TriangleMesh mesh = cube(10);
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  const CleanMesh clean = clean_mesh(mesh);
  EXPECT_EQ(clean.report.flipped_triangles, 12);
  EXPECT_NEAR(enclosed_volume(clean.mesh), 1000, 1e-9);  // side³, positive: outward
}

// A marrow cavity weighs nothing; a solid within it, and one that its file has face as the outer one does, are solids.
TEST(CleanMesh, TheWallOfACavityFacesIntoIt) {
  const auto inward = [](TriangleMesh shell) {
    for (auto& t : shell.triangles) std::swap(t[1], t[2]);
    return shell;
  };
  TriangleMesh hollow = cube(10);
  append(hollow, inward(cube(6, {2, 2, 2})));
  EXPECT_NEAR(enclosed_volume(clean_mesh(hollow).mesh), 1000 - 216, 1e-9);
  EXPECT_NEAR(enclosed_volume(clean_mesh(inward(hollow)).mesh), 1000 - 216, 1e-9);
  TriangleMesh nested = hollow;
  append(nested, cube(4, {3, 3, 3}));
  EXPECT_NEAR(enclosed_volume(clean_mesh(nested).mesh), 1000 - 216 + 64, 1e-9);
  TriangleMesh beside = cube(10);
  append(beside, inward(cube(6, {12, 2, 2})));
  EXPECT_NEAR(enclosed_volume(clean_mesh(beside).mesh), 1000 + 216, 1e-9);
}

TEST(CleanMesh, TurnsTheFewTrianglesThatDisagree) {
  TriangleMesh mesh = cube(10);
  for (const int t : {2, 7, 8}) std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
  const CleanMesh clean = clean_mesh(mesh);
  EXPECT_EQ(clean.report.flipped_triangles, 3);
  EXPECT_NEAR(enclosed_volume(clean.mesh), 1000, 1e-9);
}

TEST(CleanMesh, LeavesTheSideOfAnOpenSheetToTheMajority) {
  TriangleMesh mesh = height_sheet(20, 6, [](double, double) { return 0; });
  std::swap(mesh.triangles[5][1], mesh.triangles[5][2]);
  const CleanMesh clean = clean_mesh(mesh);
  EXPECT_EQ(clean.report.flipped_triangles, 1);
  EXPECT_FALSE(clean.closed[0]);
  for (const Vector3d& area : triangle_areas(clean.mesh)) EXPECT_GT(area.z(), 0);
}

// Two sheets of one tibia stay; a crumb of 1/400 of the area of a cube goes.
TEST(CleanMesh, DropsStraysButKeepsPiecesOfSimilarSize) {
  TriangleMesh mesh = cube(20);
  append(mesh, cube(15, {40, 0, 0}));
  append(mesh, cube(1, {70, 0, 0}));
  const CleanMesh clean = clean_mesh(mesh);
  EXPECT_EQ(clean.report.components, 2);
  EXPECT_EQ(clean.report.stray_components, 1);
  EXPECT_EQ(clean.report.stray_triangles, 12);
  EXPECT_EQ(clean.report.unreferenced_vertices, 8);
  EXPECT_EQ(clean.component.front(), 0);  // the largest comes first
}

TEST(CleanMesh, CountsEdgesOfThreeTriangles) {
  TriangleMesh mesh = cube(10);
  mesh.vertices.push_back({-8, -8, 5});
  mesh.triangles.push_back({0, 4, 8});  // a fin on the edge 0-4
  const CleanMesh clean = clean_mesh(mesh, {.stray_fraction = 0});
  EXPECT_EQ(clean.report.non_manifold_edges, 1);
}

TEST(CleanMesh, TakesAMeshWithoutTriangles) {
  const CleanMesh clean = clean_mesh(TriangleMesh{{Vector3d::Zero(), Vector3d::Ones()}, {}});
  EXPECT_TRUE(clean.mesh.vertices.empty());
  EXPECT_EQ(clean.report.components, 0);
}

TEST(CleanMesh, IsDoneAfterOnce) {
  const CleanMesh once = clean_mesh(apart(cube(10)));
  const CleanMesh twice = clean_mesh(once.mesh);
  EXPECT_EQ(twice.mesh.triangles, once.mesh.triangles);
  EXPECT_EQ(twice.report.merged_vertices + twice.report.flipped_triangles +
                twice.report.degenerate_triangles,
            0);
}

}  // namespace
}  // namespace condyle
