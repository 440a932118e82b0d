#include "phantom/phantom_shape.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <cmath>
#include <vector>

#include "phantom/femur.h"
#include "phantom/tibia.h"

namespace condyle::phantom {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Places all over the two bones, on the articular surfaces and near seams of the formula.
std::vector<Vector3d> places(Bone bone) {
  if (bone == Bone::kFemur)
    return {{4, -23, -23}, {-20, 5, 24}, {-9, 16, -20}, {30, 20, 8}, {14, 50, -14},
            {3, -1, 8},    {36, 8, 1},   {2, 7, -40},   {4, 21, 20}, {-1, -22, 30}};
  return {{5, -21, -24}, {-8, -22, 22},  {0, -15, -5},  {-18, -30, 0}, {25, -47, 2},
          {4, -80, 12},  {-15, -45, 35}, {28, -24, -5}, {0, -35, -35}, {12, -22, 30}};
}

Vector3d difference_gradient(Bone bone, const Vector3d& p, double h) {
  Vector3d g;
  for (int a = 0; a < 3; ++a)
    g[a] =
        (shape(bone, p + h * Vector3d::Unit(a)) - shape(bone, p - h * Vector3d::Unit(a))) / (2 * h);
  return g;
}

class PhantomShape : public testing::TestWithParam<Bone> {};

TEST_P(PhantomShape, GradientAgreesWithDifferences) {
  for (const Vector3d& p : places(GetParam())) {
    const ShapeValue s = shape_derivatives(GetParam(), p);
    EXPECT_NEAR(s.f, shape(GetParam(), p),
                1e-13);  // the same sums of terms up to 70 mm, in another order
    // f is of order 10 with third derivatives below 1/mm²: 1e-5² and 1e-15 10/1e-5 leave about 1e-9
    EXPECT_LT((s.g - difference_gradient(GetParam(), p, 1e-5)).norm(), 1e-8) << p.transpose();
  }
}

TEST_P(PhantomShape, HessianAgreesWithDifferencesOfTheGradient) {
  const double h = 1e-5;
  for (const Vector3d& p : places(GetParam())) {
    Matrix3d H;
    for (int a = 0; a < 3; ++a)
      H.col(a) = (shape_derivatives(GetParam(), p + h * Vector3d::Unit(a)).g -
                  shape_derivatives(GetParam(), p - h * Vector3d::Unit(a)).g) /
                 (2 * h);
    EXPECT_LT((shape_derivatives(GetParam(), p).h - H).norm(), 1e-7) << p.transpose();
  }
}

TEST_P(PhantomShape, ProjectionIsTheClosestPoint) {
  for (const Vector3d& p : places(GetParam())) {
    const Vector3d c = project(GetParam(), p);
    EXPECT_LT(std::abs(shape(GetParam(), c)), 1e-12);
    const Vector3d n = normal(GetParam(), c), offset = p - c;
    EXPECT_LT((offset - offset.dot(n) * n).norm(), 1e-9 * (1 + offset.norm())) << p.transpose();
    EXPECT_GT(shape(GetParam(), c + 0.1 * n), 0);  // n points out of the bone
  }
}

TEST_P(PhantomShape, CurvatureIsTheChangeOfTheNormal) {
  // dn = -K dc over a step of 1e-4 mm; the second-order remainder is about 1e-8 times the change of
  // curvature
  const double h = 1e-4;
  for (const Vector3d& p : places(GetParam())) {
    const SurfacePoint at = surface_point(GetParam(), p);
    EXPECT_LT((at.K * at.n).norm(), 1e-12);
    const Vector3d t = at.n.unitOrthogonal(), b = at.n.cross(t);
    for (const Vector3d& direction : {t, b}) {
      const SurfacePoint q = surface_point(GetParam(), at.c + h * direction);
      EXPECT_LT((q.n - at.n + at.K * (q.c - at.c)).norm(), 2e-8) << p.transpose();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Bones,
                         PhantomShape,
                         testing::Values(Bone::kFemur, Bone::kTibia),
                         [](const auto& test) { return bone_name(test.param); });

/// Sagittal radius at the point of a condyle that faces `angle` degrees behind distal.
double sagittal_radius(double z, double angle) {
  const double a = angle * kDegree;
  const SurfacePoint s = surface_point(Bone::kFemur, {-22 * std::sin(a), -22 * std::cos(a), z});
  const Vector3d t = Vector3d(-s.n.y(), s.n.x(), 0).normalized();
  return -1 / t.dot(s.K * t);
}

TEST(PhantomFemur, CondylesFollowAJ) {
  // docs/phantom.md: 34 to 21.5 mm medially, 36 to 20 mm laterally; blends with the neighbours may
  // add 10 %
  EXPECT_NEAR(sagittal_radius(-23.5, -5), 34, 1.5);
  EXPECT_NEAR(sagittal_radius(-23.5, 90), 21.5, 0.5);
  EXPECT_NEAR(sagittal_radius(23.5, -5), 36, 3.6);
  EXPECT_NEAR(sagittal_radius(23.5, 90), 20, 0.7);
  for (int angle = 0; angle < 60; angle += 5)  // the passage is one way, but for 2 % of blending
    EXPECT_LT(sagittal_radius(-23.5, angle + 5), 1.03 * sagittal_radius(-23.5, angle)) << angle;
}

TEST(PhantomTibia, MedialPlateauIsADishAndLateralPlateauASaddle) {
  for (const double x : {-8.0, -4.0, 0.0, 4.0, 8.0}) {
    const Matrix3d medial =
        surface_point(Bone::kTibia, {x, tibial_height(kShippedPhantom.tibia, x, -23.5), -23.5}).K;
    const Matrix3d lateral =
        surface_point(Bone::kTibia, {x, tibial_height(kShippedPhantom.tibia, x, 23.5), 23.5}).K;
    EXPECT_GT(medial(0, 0), 0.004);    // concave along x: 1/90 mm
    EXPECT_GT(medial(2, 2), 0.028);    // concave along z: 1/28 mm
    EXPECT_LT(lateral(0, 0), -0.015);  // convex along x: 1/45 mm
    EXPECT_GT(lateral(2, 2), 0.010);   // concave along z: 1/60 mm
  }
}

TEST(PhantomBones, TouchLightlyAtFullExtension) {
  // Smallest value of the femur's shape over each plateau in the common frame: the gap at the start
  // pose.
  for (const double side : {-1.0, 1.0}) {
    double gap = 100;
    for (double x = -15; x <= 22; x += 0.5)
      for (double z = 14; z <= 34; z += 0.5)
        gap = std::min(
            gap,
            shape(Bone::kFemur, {x, tibial_height(kShippedPhantom.tibia, x, side * z), side * z}));
    EXPECT_LT(std::abs(gap), 0.3) << side;
  }
}

}  // namespace
}  // namespace condyle::phantom
