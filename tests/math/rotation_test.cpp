#include "condyle/math/rotation.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

#include "condyle/math/rigid_transform.h"
#include "support/random.h"

namespace condyle {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using test::Random;

constexpr double kRoundOff = 1e-14;  // a few dozen operations on numbers near 1

/// The definition: Σ [θ]xⁿ/n!.
Matrix3d exponential_series(const Vector3d& theta) {
  const Matrix3d S = skew(theta);
  Matrix3d sum = Matrix3d::Identity(), term = Matrix3d::Identity();
  for (int n = 1; n < 60; ++n) {
    term = term * S / n;
    sum += term;
  }
  return sum;
}

TEST(Rotation, SkewIsTheCrossProduct) {
  const Vector3d v(1, -2, 3), w(0.5, 4, -1);
  EXPECT_EQ(skew(v) * w, v.cross(w));
  EXPECT_EQ(skew(v).transpose(), -skew(v));
}

TEST(Rotation, ExponentialIsItsSeriesAtEverySize) {
  Random random(1);
  // On both sides of the branch near zero, and up to a full turn.
  for (const double angle : {0.0, 1e-12, 1e-2, 0.24, 0.25, 1.0, std::numbers::pi, 6.0}) {
    const Vector3d theta = angle * random.direction();
    EXPECT_LT((exp_rotation(theta) - exponential_series(theta)).norm(), 20 * kRoundOff) << angle;
  }
}

TEST(Rotation, QuarterTurnAboutZTakesXToY) {
  const Matrix3d R = exp_rotation(std::numbers::pi / 2 * Vector3d::UnitZ());
  EXPECT_LT((R * Vector3d::UnitX() - Vector3d::UnitY()).norm(), kRoundOff);
}

TEST(Rotation, CayleyVectorIsTwiceTheTangentOfHalfTheAngleAndBack) {
  Random random(3);
  for (const double angle : {0.0, 1e-9, 0.1, 1.0, 3.0}) {
    const Vector3d axis = random.direction(), c = 2 * std::tan(angle / 2) * axis;
    const Matrix3d R = exp_rotation(angle * axis);
    EXPECT_LT((cayley_vector(R) - c).norm(), 1e-13 * (1 + c.squaredNorm())) << angle;
    EXPECT_LT((cayley_rotation(c) - R).norm(), kRoundOff) << angle;
  }
}

TEST(Rotation, LogarithmGivesBackTheRotationVectorUpToHalfATurn) {
  Random random(2);
  for (const double angle :
       {0.0, 1e-15, 1e-9, 1e-5, 0.3, 2.0, 3.1, std::numbers::pi - 1e-7, std::numbers::pi - 1e-12}) {
    const Vector3d theta = angle * random.direction();
    EXPECT_LT((log_rotation(exp_rotation(theta)) - theta).norm(), 1e-13 * angle + 1e-15) << angle;
  }
}

TEST(Rotation, LogarithmOfHalfATurnIsOneOfItsTwoVectors) {
  const Vector3d theta = std::numbers::pi * Vector3d(1, 2, -2) / 3;
  const Vector3d found = log_rotation(exp_rotation(theta));
  EXPECT_LT(std::min((found - theta).norm(), (found + theta).norm()), 1e-13);
}

TEST(Rotation, OrthonormalizedRemovesWhatManyProductsLeave) {
  Random random(3);
  Matrix3d R = random.rotation();
  const Matrix3d exact = R;
  R += 1e-9 * Matrix3d::Ones();
  const Matrix3d mended = orthonormalized(R);
  EXPECT_LT((mended.transpose() * mended - Matrix3d::Identity()).norm(), kRoundOff);
  EXPECT_LT((mended - exact).norm(), 1e-8);
  EXPECT_LT((orthonormalized(exact) - exact).norm(), kRoundOff);
}

TEST(RigidTransform, InverseUndoesAndCompositionAssociates) {
  Random random(4);
  const RigidTransform X_AB = random.pose(100), X_BC = random.pose(100);
  const Vector3d p_C = random.vector(50);
  EXPECT_LT(((X_AB * X_BC) * p_C - X_AB * (X_BC * p_C)).norm(), 1e-12);
  EXPECT_LT((X_AB.inverse() * (X_AB * p_C) - p_C).norm(), 1e-12);
  EXPECT_LT(((X_AB * X_AB.inverse()).R - Matrix3d::Identity()).norm(), kRoundOff);
}

}  // namespace
}  // namespace condyle
