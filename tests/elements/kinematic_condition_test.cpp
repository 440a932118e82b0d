#include "condyle/elements/kinematic_condition.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <numbers>

#include "support/allocation_count.h"
#include "support/numerical_jacobian.h"
#include "support/random.h"

namespace condyle {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using test::Random;

constexpr std::array kAllKinds = {
    ConditionKind::kFlexion,      ConditionKind::kAdduction,      ConditionKind::kInternalRotation,
    ConditionKind::kLateralShift, ConditionKind::kAnteriorDrawer, ConditionKind::kDistraction,
    ConditionKind::kTranslation,  ConditionKind::kRotation,       ConditionKind::kDistance};

KinematicCondition random_condition(Random& random, ConditionKind kind, int variant) {
  KinematicCondition condition;
  condition.kind = kind;
  condition.value = random.between(-1, 1);
  condition.frames = {random.pose(30), random.pose(30), variant % 2 == 0,
                      variant % 4 < 2 ? 1. : -1.};
  condition.axis = random.direction();
  condition.cardan_axis = variant % 3;
  condition.x_C = random.vector(50);
  condition.s_D = random.vector(50);
  return condition;
}

/// A pose away from the places where the angles have no derivative.
RigidTransform tame_pose(Random& random, const KinematicCondition& condition) {
  for (;;) {
    const RigidTransform X = random.pose(30);
    const bool steep = condition.kind == ConditionKind::kRotation
                           ? std::abs(X.R(2, 1)) > 0.95
                           : std::abs(joint_coordinates(condition.frames, X).adduction) > 1.25;
    if (!steep) return X;
  }
}

TEST(KinematicCondition, GradientIsExactForEveryKind) {
  Random random(41);
  using Row = Eigen::Matrix<double, 1, 1>;
  for (const ConditionKind kind : kAllKinds) {
    for (int variant = 0; variant < 24; ++variant) {
      KinematicCondition condition = random_condition(random, kind, variant);
      const RigidTransform X = tame_pose(random, condition);
      condition.value =
          evaluate(condition, condition.value, X).coordinate;  // so that no angle wraps nearby
      const auto k = [&](const Vector3d& da, const Vector3d& dpi) -> Row {
        return Row(evaluate(condition, condition.value, test::displaced(X, da, dpi)).k);
      };
      const Vector3d zero = Vector3d::Zero();
      const auto by_a =
          test::jacobian_at_zero<1, 3>([&](const Vector3d& da) { return k(da, zero); });
      const auto by_pi =
          test::jacobian_at_zero<1, 3>([&](const Vector3d& dpi) { return k(zero, dpi); });
      const ConditionDerivatives d = evaluate(condition, condition.value, X);
      EXPECT_LT((d.alpha - by_a.transpose()).norm(), 1e-8 * (1 + d.alpha.norm()))
          << static_cast<int>(kind);
      EXPECT_LT((d.eta - by_pi.transpose()).norm(), 1e-8 * (1 + d.eta.norm()))
          << static_cast<int>(kind);
    }
  }
}

TEST(KinematicCondition, SecondDerivativesAreExactForEveryKind) {
  Random random(42);
  for (const ConditionKind kind : kAllKinds) {
    for (int variant = 0; variant < 24; ++variant) {
      const KinematicCondition condition = random_condition(random, kind, variant);
      const RigidTransform X = tame_pose(random, condition);
      const auto alpha = [&](const RigidTransform& at) {
        return evaluate(condition, condition.value, at).alpha;
      };
      const auto eta = [&](const RigidTransform& at) {
        return evaluate(condition, condition.value, at).eta;
      };
      const ConditionDerivatives d = evaluate(condition, condition.value, X);
      const auto close = [](const Matrix3d& found, const Matrix3d& expected) {
        return (found - expected).norm() < 1e-8 * (1 + expected.norm());
      };
      const int name = static_cast<int>(kind);
      EXPECT_TRUE(close(d.D1, test::jacobian_of_translation(alpha, X)))
          << name << " variant " << variant;
      EXPECT_TRUE(close(d.D2, test::jacobian_of_rotation(alpha, X)))
          << name << " variant " << variant;
      EXPECT_TRUE(close(d.D3, test::jacobian_of_translation(eta, X)))
          << name << " variant " << variant;
      EXPECT_TRUE(close(d.D4, test::jacobian_of_rotation(eta, X)))
          << name << " variant " << variant;
    }
  }
}

TEST(KinematicCondition, CoordinatesAreTheJointCoordinates) {
  Random random(43);
  for (int variant = 0; variant < 8; ++variant) {
    KinematicCondition condition = random_condition(random, ConditionKind::kFlexion, variant);
    const RigidTransform X = random.pose(30);
    const JointCoordinates q = joint_coordinates(condition.frames, X);
    const std::array<double, 6> expected = {q.flexion,       q.adduction,       q.internal_rotation,
                                            q.lateral_shift, q.anterior_drawer, q.distraction};
    for (std::size_t i = 0; i < 6; ++i) {
      condition.kind = kAllKinds[i];
      EXPECT_NEAR(evaluate(condition, condition.value, X).coordinate, expected[i], 1e-11);
    }
  }
}

/// R = Rz(φ) Rx'(ψ) Ry''(ω)
Matrix3d cardan(double phi, double psi, double omega) {
  return exp_rotation(phi * Vector3d::UnitZ()) * exp_rotation(psi * Vector3d::UnitX()) *
         exp_rotation(omega * Vector3d::UnitY());
}

TEST(KinematicCondition, CardanAnglesAreThoseTheRotationWasMadeOf) {
  KinematicCondition condition;
  condition.kind = ConditionKind::kRotation;
  const double phi = 2.5, psi = -0.8, omega = -3.0;
  const std::array<double, 3> by_axis = {psi, omega, phi};
  for (int axis = 0; axis < 3; ++axis) {
    condition.cardan_axis = axis;
    EXPECT_NEAR(evaluate(condition, condition.value, {cardan(phi, psi, omega), Vector3d::Zero()})
                    .coordinate,
                by_axis[axis], 1e-14);
  }
}

TEST(KinematicCondition, GradientOfTheLastCardanAngleIsThatOfTheTheory) {
  // [Dortmans 1986, App. D]: η of ω is (-sin φ, cos φ, 0)/cos ψ.
  KinematicCondition condition;
  condition.kind = ConditionKind::kRotation;
  condition.cardan_axis = 1;
  const double phi = 0.7, psi = 0.4;
  const ConditionDerivatives d =
      evaluate(condition, condition.value, {cardan(phi, psi, 1.1), Vector3d::Zero()});
  EXPECT_LT((d.eta - Vector3d(-std::sin(phi), std::cos(phi), 0) / std::cos(psi)).norm(), 1e-14);
}

TEST(KinematicCondition, AnglesAreComparedTheShortWayRound) {
  KinematicCondition condition;
  condition.kind = ConditionKind::kRotation;
  condition.cardan_axis = 2;
  condition.value = 3.1;
  const ConditionDerivatives d =
      evaluate(condition, condition.value, {cardan(-3.1, 0, 0), Vector3d::Zero()});
  EXPECT_NEAR(d.coordinate, -3.1, 1e-14);
  EXPECT_NEAR(d.k, 2 * std::numbers::pi - 6.2, 1e-14);
}

TEST(KinematicCondition, MultiplierOfAnAngleTurnsAboutItsAxis) {
  // With the frames aligned the tibia flexes about -I: dflexion = -dπ.I.
  KinematicCondition condition;
  const ConditionDerivatives d = evaluate(condition, condition.value, {});
  EXPECT_LT((d.eta + Vector3d::UnitX()).norm(), 1e-15);
  EXPECT_EQ(d.alpha, Vector3d::Zero());
}

TEST(KinematicCondition, DistanceOfAnIsometricFibreIsItsLength) {
  KinematicCondition condition;
  condition.kind = ConditionKind::kDistance;
  condition.value = 4;
  condition.x_C = {1, 1, 1};
  condition.s_D = {1, 0, 0};
  // D at (4, 5, 1): (3, 4, 0) from C.
  const ConditionDerivatives d =
      evaluate(condition, condition.value, {Matrix3d::Identity(), Vector3d(3, 5, 1)});
  EXPECT_NEAR(d.k, 1, 1e-15);
  EXPECT_LT((d.alpha - Vector3d(0.6, 0.8, 0)).norm(), 1e-15);
}

bool finite(const ConditionDerivatives& d) {
  return std::isfinite(d.coordinate) && std::isfinite(d.k) && d.alpha.allFinite() &&
         d.eta.allFinite() && d.D1.allFinite() && d.D2.allFinite() && d.D3.allFinite() &&
         d.D4.allFinite();
}

TEST(KinematicCondition, StaysFiniteWhereTheCoordinateHasNoDerivative) {
  KinematicCondition condition;
  for (const ConditionKind kind : kAllKinds) {
    condition.kind = kind;
    for (const double angle : {std::numbers::pi / 2, -std::numbers::pi / 2}) {
      const Vector3d p(1, 2, 3);
      EXPECT_TRUE(finite(
          evaluate(condition, condition.value, {exp_rotation(angle * Vector3d::UnitY()), p})))
          << static_cast<int>(kind);
      EXPECT_TRUE(finite(
          evaluate(condition, condition.value, {exp_rotation(angle * Vector3d::UnitX()), p})))
          << static_cast<int>(kind);
    }
    EXPECT_TRUE(finite(evaluate(condition, condition.value, {})))
        << static_cast<int>(kind);  // a distance of zero
    // The axes of the joint and of the Cardan angles exactly parallel.
    Matrix3d R;
    R << 0, 0, 1, 1, 0, 0, 0, 1, 0;
    EXPECT_TRUE(finite(evaluate(condition, condition.value, {R, Vector3d(1, 2, 3)})))
        << static_cast<int>(kind);
  }
}

TEST(KinematicCondition, AllocatesNothing) {
  KinematicCondition condition;
  double sum = 0;
  const test::AllocationCount count;
  for (const ConditionKind kind : kAllKinds) {
    condition.kind = kind;
    sum += evaluate(condition, condition.value, {}).k;
  }
  EXPECT_EQ(count.since_start(), 0);
  EXPECT_TRUE(std::isfinite(sum));
}

}  // namespace
}  // namespace condyle
