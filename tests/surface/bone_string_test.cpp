/// Shortest strings about meshes of solids for which the shortest path is known.

#include "condyle/specimen/bone_string.h"

#include <gtest/gtest.h>

#include <cmath>

#include "condyle/math/rigid_transform.h"
#include "condyle/math/rotation.h"
#include "support/closed_shapes.h"

namespace condyle {
namespace {

using Eigen::Vector3d;
using test::cylinder_solid;
using test::ellipsoid_solid;

/// Between points at the distances a and b from the middle of a circle, the angle `between` apart.
double round_a_circle(double radius, double a, double b, double between) {
  return std::sqrt(a * a - radius * radius) + std::sqrt(b * b - radius * radius) +
         radius * (between - std::acos(radius / a) - std::acos(radius / b));
}

double angle(const Vector3d& a, const Vector3d& b) {
  return std::acos(a.dot(b) / (a.norm() * b.norm()));
}

TEST(SmoothedMesh, OfASphereIsTheSphere) {
  const TriangleMesh mesh = ellipsoid_solid(Vector3d::Constant(20), 1.5);
  const SmoothedMesh bone(mesh);
  for (const Vector3d& u : {Vector3d(1, 2, 3), Vector3d(-3, 1, 0.2), Vector3d(0.1, -2, 1)})
    for (const double r : {19.5, 20.0, 20.7}) {
      const SurfaceHeight at = bone.height(r * u.normalized());
      // Moving least squares with h = 1.5 to 1.6 mm: the terms in h²/r, 0.06 mm each, cancel.
      EXPECT_NEAR(at.height, r - 20, 0.006);
      EXPECT_NEAR((at.normal - u.normalized()).norm(), 0, 0.005);
      // Triangles lie up to 1.5²/(8·20) mm or so below the sphere.
      EXPECT_NEAR(bone.signed_distance(r * u.normalized()), r - 20, 0.03);
    }
  EXPECT_NEAR(bone.signed_distance({0, 0, 3}), -17, 0.03);
  EXPECT_NEAR(bone.signed_distance({0, 50, 0}), 30, 0.03);
}

TEST(BoneString, RoundASphereIsTangentsAndAnArc) {
  const TriangleMesh mesh = ellipsoid_solid(Vector3d::Constant(20), 1.5);
  const SmoothedMesh bone(mesh);
  const Vector3d x(-35, 5, 8), y(30, -12, 6);  // S1 of the checks of wrapped paths
  const BonePath path = bone_string(bone, x, y);
  ASSERT_TRUE(path.found);
  EXPECT_NEAR(path.length, round_a_circle(20, x.norm(), y.norm(), angle(x, y)), 0.01);
  EXPECT_DOUBLE_EQ(path.straight, (y - x).norm());
  // The line passes the middle at a distance of |x × y|/|y - x|.
  EXPECT_NEAR(path.depth, 20 - x.cross(y).norm() / (y - x).norm(), 0.05);
  for (const StringTouch& touch : path.touches) {
    EXPECT_NEAR(touch.point.norm(), 20, 0.01);
    EXPECT_NEAR(touch.point.dot(x.cross(y).normalized()), 0, 0.05);  // in the plane of the ends
  }
  // The arc is 15.37 mm long.
  ASSERT_GT(path.touches.size(), 2U);
  EXPECT_NEAR((path.touches.back().point - path.touches.front().point).norm(), 15, 1.5);
}

TEST(BoneString, RoundACylinderIsAHelix) {
  const TriangleMesh mesh = cylinder_solid(18, 120, 1.5);
  const SmoothedMesh bone(mesh);
  const Vector3d x(-25, 4, -10), y(22, 9, 25);
  const BonePath path = bone_string(bone, x, y);
  ASSERT_TRUE(path.found);
  const Vector3d a(x.x(), x.y(), 0), b(y.x(), y.y(), 0);
  const double unrolled = round_a_circle(18, a.norm(), b.norm(), angle(a, b));
  EXPECT_NEAR(path.length, std::hypot(unrolled, 35), 0.02);  // 63.66629981375
  for (const StringTouch& touch : path.touches) EXPECT_GT(touch.point.y(), 0);
}

// The side on which the straight line leaves first, however the solid lies.
TEST(BoneString, PassesOnTheSideThatIsNearest) {
  const TriangleMesh mesh = ellipsoid_solid({30, 18, 12}, 1.5);
  const SmoothedMesh bone(mesh);
  for (const double side : {-1.0, 1.0}) {
    const BonePath path = bone_string(bone, {-40, 2, 3 * side}, {40, -2, 2 * side});
    ASSERT_TRUE(path.found);
    ASSERT_FALSE(path.touches.empty());
    for (const StringTouch& touch : path.touches) EXPECT_GT(side * touch.point.z(), 5);
  }
}

TEST(BoneString, ThatMeetsNothingIsStraight) {
  const TriangleMesh mesh = ellipsoid_solid(Vector3d::Constant(20), 2);
  const SmoothedMesh bone(mesh);
  const BonePath path = bone_string(bone, {-30, 21, 0}, {30, 21, 0});
  EXPECT_TRUE(path.found);
  EXPECT_NEAR(path.length, 60, 1e-9);
  EXPECT_EQ(path.depth, 0);
  EXPECT_TRUE(path.touches.empty());
}

// An insertion on the bone or under its surface: the string begins where it comes out.
TEST(BoneString, BeginsOnTheSurfaceOverAnEndInside) {
  const TriangleMesh mesh = ellipsoid_solid(Vector3d::Constant(20), 1.5);
  const SmoothedMesh bone(mesh);
  const Vector3d y(0, 30, 0), on = 20 * Vector3d(1, 0.2, 0).normalized();
  for (const double r : {20.0, 19.0, 17.0}) {
    const BonePath path = bone_string(bone, on * (r / 20), y);
    ASSERT_TRUE(path.found);
    EXPECT_NEAR(path.moved[0], 20 - r, 0.02);
    EXPECT_EQ(path.moved[1], 0);
    EXPECT_NEAR(path.length, round_a_circle(20, 20.000001, 30, angle(on, y)), 0.03);
  }
}

// Turned and moved, a string is turned and moved.
TEST(BoneString, GoesWithTheBone) {
  TriangleMesh mesh = ellipsoid_solid({30, 18, 12}, 2);
  const Vector3d x(-24, 20, 3), y(22, -6, 15);
  const double length = bone_string(SmoothedMesh(mesh), x, y).length;
  const RigidTransform X{exp_rotation({0.3, -1.1, 0.4}), {100, -200, 50}};
  for (Vector3d& p : mesh.vertices) p = X * p;
  const SmoothedMesh bone(mesh);
  // 54.34474617886 over the exact ellipsoid (S7).
  EXPECT_NEAR(length, 54.3447, 0.02);
  EXPECT_NEAR(bone_string(bone, X * x, X * y).length, length, 2e-3);
  EXPECT_NEAR(bone_string(bone, X * y, X * x).length, length, 2e-3);
}

}  // namespace
}  // namespace condyle
