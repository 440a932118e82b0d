#include "condyle/elements/load.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "support/allocation_count.h"
#include "support/numerical_jacobian.h"
#include "support/random.h"

namespace condyle {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using test::Random;

Wrench wrench_of(const Load& load, const RigidTransform& X) {
  Wrench wrench;
  add_load(load, load.scale, X, wrench);
  return wrench;
}

void expect_exact_derivatives(const Load& load, const RigidTransform& X) {
  const auto force = [&](const RigidTransform& at) { return wrench_of(load, at).f; };
  const auto moment = [&](const RigidTransform& at) { return wrench_of(load, at).m; };
  const Wrench w = wrench_of(load, X);
  const double scale = 1 + w.f.norm() + w.m.norm();
  EXPECT_LT((w.F1 - test::jacobian_of_translation(force, X)).norm(), 1e-9 * scale);
  EXPECT_LT((w.F2 - test::jacobian_of_rotation(force, X)).norm(), 1e-9 * scale);
  EXPECT_LT((w.M1 - test::jacobian_of_translation(moment, X)).norm(), 1e-9 * scale);
  EXPECT_LT((w.M2 - test::jacobian_of_rotation(moment, X)).norm(), 1e-9 * scale);
}

TEST(Load, DeadForceKeepsItsDirectionAndItsMomentFollowsThePoint) {
  // Turned by 90 degrees about z the point (10, 0, 0) is at (0, 10, 0): (0, 10, 0) x (0, 0, 3) =
  // (30, 0, 0).
  Load load;
  load.vector = {0, 0, 3};
  load.at = {10, 0, 0};
  const RigidTransform X{exp_rotation(std::acos(0.0) * Vector3d::UnitZ()), Vector3d(7, 8, 9)};
  const Wrench w = wrench_of(load, X);
  EXPECT_LT((w.f - Vector3d(0, 0, 3)).norm(), 1e-14);
  EXPECT_LT((w.m - Vector3d(30, 0, 0)).norm(), 1e-13);
}

TEST(Load, FollowerForceTurnsWithTheBody) {
  Load load;
  load.follows_body = true;
  load.vector = {2, 0, 0};
  const RigidTransform X{exp_rotation(std::acos(0.0) * Vector3d::UnitZ()), Vector3d::Zero()};
  EXPECT_LT((wrench_of(load, X).f - Vector3d(0, 2, 0)).norm(), 1e-14);
}

TEST(Load, DerivativesAreExactForForcesAndMomentsDeadOrFollowing) {
  Random random(21);
  for (const bool moment : {false, true}) {
    for (const bool follows_body : {false, true}) {
      Load load;
      load.moment = moment;
      load.follows_body = follows_body;
      load.vector = random.vector(100);
      load.at = random.vector(50);
      load.scale = 0.7;
      expect_exact_derivatives(load, random.pose(30));
    }
  }
}

TEST(Load, CustomLoadIsAddedAndScaled) {
  // A spring of 3 N/mm from O_A to the origin: f = -3 a.
  Load load;
  load.custom = [](const RigidTransform& X, Wrench& wrench) {
    wrench.f = -3 * X.p;
    wrench.F1 = -3 * Matrix3d::Identity();
  };
  load.scale = 2;
  Wrench wrench;
  wrench.f = Vector3d(1, 1, 1);  // what is there stays
  add_load(load, load.scale, {Matrix3d::Identity(), Vector3d(1, 2, 3)}, wrench);
  EXPECT_LT((wrench.f - Vector3d(-5, -11, -17)).norm(), 1e-14);
  expect_exact_derivatives(load, {Matrix3d::Identity(), Vector3d(1, 2, 3)});
}

TEST(Load, AllocatesNothing) {
  Load load;
  load.vector = {0, 100, 0};
  Wrench wrench;
  const test::AllocationCount count;
  add_load(load, 1, {}, wrench);
  EXPECT_EQ(count.since_start(), 0);
}

}  // namespace
}  // namespace condyle
