#pragma once

/// Two sweeps that must be the same but for round-off and computing time.

#include <gtest/gtest.h>

#include "condyle/equilibrium/pose_result.h"

namespace condyle::test {

inline constexpr double kSame = 1e-9;  ///< [mm], [rad], [-]; forces relative to 1 N and more

inline void expect_same_force(double a, double b) {
  EXPECT_NEAR(a, b, kSame * std::max(1.0, std::abs(a)));
}

inline void expect_same_pose(const PoseResult& a, const PoseResult& b) {
  EXPECT_NEAR(a.value, b.value, 1e-12);
  ASSERT_EQ(a.status, b.status) << a.value << ": " << a.reason << " / " << b.reason;
  EXPECT_EQ(a.reason, b.reason);
  EXPECT_EQ(a.stability, b.stability);
  if (!a.converged()) return;
  EXPECT_LT((a.X_BA.p - b.X_BA.p).norm(), kSame);
  EXPECT_LT((a.X_BA.R - b.X_BA.R).norm(), kSame);
  ASSERT_EQ(a.contacts.size(), b.contacts.size());
  for (std::size_t i = 0; i < a.contacts.size(); ++i) {
    const ContactResult &c = a.contacts[i], &d = b.contacts[i];
    EXPECT_EQ(c.closed, d.closed);
    expect_same_force(c.force, d.force);
    ASSERT_EQ(c.points.size(), d.points.size());
    for (std::size_t k = 0; c.closed && k < c.points.size(); ++k)
      EXPECT_LT((c.points[k].point_ground - d.points[k].point_ground).norm(), 1e2 * kSame);
  }
  ASSERT_EQ(a.ligaments.size(), b.ligaments.size());
  for (std::size_t i = 0; i < a.ligaments.size(); ++i)
    expect_same_force(a.ligaments[i].force, b.ligaments[i].force);
  ASSERT_EQ(a.conditions.size(), b.conditions.size());
  for (std::size_t i = 0; i < a.conditions.size(); ++i)
    expect_same_force(a.conditions[i].multiplier, b.conditions[i].multiplier);
}

inline void expect_same_sweep(const SweepResult& a, const SweepResult& b) {
  ASSERT_EQ(a.poses.size(), b.poses.size());
  for (std::size_t i = 0; i < a.poses.size(); ++i) expect_same_pose(a.poses[i], b.poses[i]);
  ASSERT_EQ(a.events.size(), b.events.size());
  for (std::size_t i = 0; i < a.events.size(); ++i) {
    EXPECT_EQ(a.events[i].kind, b.events[i].kind);
    EXPECT_EQ(a.events[i].contact, b.events[i].contact);
    EXPECT_NEAR(a.events[i].value, b.events[i].value, 2e-9);  // located to 1e-9 in either
  }
}

}  // namespace condyle::test
