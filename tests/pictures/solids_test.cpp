#include "condyle/pictures/solids.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <map>

#include "support/block_knee.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

double volume(const ShadedMesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vector3d p = mesh.vertices[a].position.cast<double>(),
                   q = mesh.vertices[b].position.cast<double>();
    sum += p.dot(q.cross(mesh.vertices[c].position.cast<double>())) / 6;
  }
  return sum;
}

void expect_normals_agree_with_faces(const ShadedMesh& mesh) {
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3f p = mesh.vertices[a].position;
    const Eigen::Vector3f n = (mesh.vertices[b].position - p).cross(mesh.vertices[c].position - p);
    if (n.norm() < 1e-5) continue;  // a sliver at a pole
    for (const auto i : {a, b, c}) EXPECT_GT(n.normalized().dot(mesh.vertices[i].normal), 0.1);
  }
}

TEST(Solids, ABallHasTheVolumeOfABallAndFacesOutward) {
  const ShadedMesh mesh = ball({3, 4, 5}, 2, {});
  // A polyhedron of 12 sides and 10 rings inscribed in the ball keeps about nine tenths of 4/3 π
  // r³.
  EXPECT_NEAR(volume(mesh), 33.51, 0.12 * 33.51);
  EXPECT_LT(volume(mesh), 33.51);
  expect_normals_agree_with_faces(mesh);
}

TEST(Solids, ATubeKeepsItsRadiusAroundABend) {
  const std::vector<Vector3d> line = {{0, 0, 0}, {10, 0, 0}, {17, 7, 0}, {17, 17, 3}};
  std::vector<TubePoint> points;
  for (const Vector3d& p : line) points.push_back({p, 1.5, {}});
  const ShadedMesh mesh = tube(points);
  expect_normals_agree_with_faces(mesh);
  for (const ShadedVertex& vertex : mesh.vertices) {
    double nearest = 1e9;
    for (const Vector3d& p : line)
      nearest = std::min(nearest, (vertex.position.cast<double>() - p).norm());
    EXPECT_NEAR(nearest, 1.5, 1e-5) << "all rings and caps are 1.5 mm from a point of the line";
  }
}

TEST(Solids, AnArrowEndsAtItsHead) {
  const ShadedMesh mesh = arrow({0, 0, 0}, {0, 20, 0}, 1, {});
  double top = -1;
  for (const ShadedVertex& vertex : mesh.vertices)
    top = std::max(top, static_cast<double>(vertex.position.y()));
  EXPECT_NEAR(top, 20, 1e-5);
  EXPECT_GT(volume(mesh), 0);
}

TEST(ShadedMesh, NormalsOfABoxPointOutOfIt) {
  const ShadedMesh mesh = shade(box({0, 0, 0}, {2, 2, 2}), {}, 0);
  for (const ShadedVertex& vertex : mesh.vertices) {
    EXPECT_GT(vertex.normal.dot(vertex.position - Eigen::Vector3f(1, 1, 1)), 0);
    EXPECT_NEAR(vertex.normal.norm(), 1, 1e-6);
  }
}

TEST(ShadedMesh, OnlyAMeshWithoutGapsThatFacesOutwardIsClosed) {
  const TriangleMesh whole = box({0, 0, 0}, {2, 2, 2});
  EXPECT_TRUE(is_closed(whole));
  TriangleMesh open = whole, inside_out = whole, flipped = whole;
  open.triangles.pop_back();
  for (auto& triangle : inside_out.triangles) std::swap(triangle[0], triangle[1]);
  std::swap(flipped.triangles[0][0], flipped.triangles[0][1]);
  EXPECT_FALSE(is_closed(open));
  EXPECT_FALSE(is_closed(inside_out));
  EXPECT_FALSE(is_closed(flipped));
  EXPECT_FALSE(is_closed({}));
}

TEST(ShadedMesh, AppendedPartsKeepTheirTriangles) {
  ShadedMesh whole = ball({0, 0, 0}, 1, {});
  const double one = volume(whole);
  append(whole, ball({10, 0, 0}, 1, {}));
  EXPECT_NEAR(volume(whole), 2 * one, 1e-4);  // single precision
}

}  // namespace
}  // namespace condyle
