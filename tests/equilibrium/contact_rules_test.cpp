#include "condyle/equilibrium/contact_rules.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>

#include "condyle/equilibrium/equilibrium_solver.h"
#include "condyle/equilibrium/model_covers.h"
#include "condyle/math/rotation.h"
#include "support/two_feet.h"

namespace condyle {
namespace {

using test::hold;
using test::on_two_feet;

// Held closed means that one point touches, whatever it carries: its surfaces may overlap nowhere else.
TEST(ContactRules, WhatIsHeldAtOnePointOverlapsAtNoOther) {
  Model model = on_two_feet(ContactMode::kClosed);
  hold(model, ConditionKind::kRotation, 1, 0.05);  // the foot at x = 5 is lower
  for (const double foot : {-5.0, 5.0}) {
    model.pairs[0].start = {{foot, 0, 0}};
    model.start.p.z() = 0.25;
    const PoseResult pose = EquilibriumSolver(model).solve();
    ASSERT_TRUE(pose.converged()) << foot << ": " << pose.reason;
    ASSERT_EQ(pose.contacts[0].points.size(), 1U);
    EXPECT_GT(pose.contacts[0].points[0].point_ground.x(), 4) << foot;
    EXPECT_NEAR(pose.contacts[0].force, 10, 1e-9);
  }
}

// Free to tilt it stands on both, as an automatic contact does.
TEST(ContactRules, WhatIsHeldAtOnePointMayTouchAtMore) {
  for (const ContactMode mode : {ContactMode::kClosed, ContactMode::kAuto}) {
    Model model = on_two_feet(mode);
    model.start.p.z() = 0.2;
    const PoseResult pose = EquilibriumSolver(model).solve();
    ASSERT_TRUE(pose.converged()) << pose.reason;
    ASSERT_EQ(pose.contacts[0].points.size(), 2U);
    for (const ContactPointResult& point : pose.contacts[0].points)
      EXPECT_NEAR(point.force, point.point_ground.x() < 0 ? 3.8 : 6.2, 1e-9);
  }
}

// The back of a sheet, 8 mm in front of a wall: its solid would lie in that of the wall.
TEST(OpenPair, WhoseSurfacesTurnTheirBacksToEachOtherFacesNothing) {
  Model model;
  ContactPair pair;
  pair.on_B = make_plane({0, 0, 0}, {0, 0, 1}, 60);
  pair.on_A =
      make_polynomial({0, 0, 0}, Eigen::Matrix3d::Identity(), {{2, 0, -0.02}, {0, 2, -0.02}},
                      /*solid_inside=*/true, 12);
  model.pairs = {pair};
  std::vector<ContactSearch> searches = make_searches(model, cover_pairs(model));
  std::vector<GapMinimum> nearest;
  const auto lies = [&](const RigidTransform& X) {
    return look_at_open_pair(model.pairs[0], searches[0], X, 30, nearest);
  };
  EXPECT_EQ(lies({exp_rotation({0.2, 0, 0}), {1, 2, 14}}), OpenPair::kApart);
  EXPECT_EQ(lies({exp_rotation({M_PI - 0.2, 0, 0}), {1, 2, 8}}), OpenPair::kClear);
}

}  // namespace
}  // namespace condyle
