/// Loose pieces about a bone are told and left out; a mesh that falls into pieces is kept.

#include "condyle/mesh/main_parts.h"

#include <gtest/gtest.h>

#include "support/mesh_shapes.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

TEST(MainParts, LeaveOutLoosePieces) {
  TriangleMesh mesh = test::cube(10);
  const std::size_t own = mesh.triangles.size();
  EXPECT_EQ(main_parts(mesh).left_out, 0);
  test::append(mesh, test::cube(3, {20, 0, 0}));
  test::append(mesh, test::cube(2, {0, 20, 0}));
  const MainParts parts = main_parts(mesh);
  EXPECT_EQ(parts.left_out, 2);
  EXPECT_EQ(parts.mesh.triangles.size(), own);
  EXPECT_LT((parts.middle - Vector3d(21.5, 1.5, 1.5)).norm(), 1e-12);
  EXPECT_LT((parts.size - Vector3d(3, 3, 3)).norm(), 1e-12);
}

TEST(MainParts, KeepWhatFallsIntoPieces) {
  TriangleMesh mesh = test::cube(10);
  for (int k = 0; k < 9; ++k) test::append(mesh, test::cube(4, {20.0 + 6 * k, 0, 0}));
  const MainParts parts = main_parts(mesh);
  EXPECT_EQ(parts.left_out, 0);
  EXPECT_EQ(parts.mesh.triangles.size(), mesh.triangles.size());
}

TEST(MainParts, OfNothingAreNothing) { EXPECT_TRUE(main_parts({}).mesh.triangles.empty()); }

}  // namespace
}  // namespace condyle
