/// Surfaces that lie behind each other, beside an edge or in a hollow solid, without touching.

#include "condyle/equilibrium/passed_through.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <optional>

#include "condyle/math/rotation.h"
#include "condyle/surface/exact_surfaces.h"
#include "support/counted_model.h"
#include "support/known_part.h"

namespace condyle {
namespace {

/// Two discs that face each other, the fixed one about the origin.
ContactPair discs(double fixed_radius, double moving_radius) {
  ContactPair pair;
  pair.on_B = make_plane(Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ(), fixed_radius);
  pair.on_A = make_plane(Eigen::Vector3d::Zero(), -Eigen::Vector3d::UnitZ(), moving_radius);
  return pair;
}

// Two discs that face each other: one that slid off the other's edge and went on behind it faces
// nothing, beside it and in front it is only open.
TEST(PassedThrough, WhatSlidOffAnEdgeAndWentOnBehindIsBehind) {
  const ContactPair pair = discs(12, 12);
  const PassedThrough passed(pair, 30);
  const auto depth = [&](double x, double z) {
    return passed.depth({exp_rotation({0.05, -0.1, 0.3}), {x, 0, z}});
  };
  EXPECT_FALSE(depth(0, 2).has_value());
  EXPECT_FALSE(depth(40, 5).has_value());
  EXPECT_FALSE(depth(40, -7).has_value()) << "12.8 mm, as deep as the search sees";
  ASSERT_TRUE(depth(40, -40).has_value());
  EXPECT_NEAR(*depth(40, -40), 43, 3);  // of the lower part of the tilted disc
  ASSERT_TRUE(depth(0, -20).has_value());
  EXPECT_NEAR(*depth(0, -20), 20, 2);
}

// A large disc stands beside a small one, its lower half behind it: as much of it lies in front.
TEST(PassedThrough, WhatStandsHalfBehindAnEdgeIsBehind) {
  const ContactPair pair = discs(12, 30);
  const PassedThrough passed(pair, 30);
  const Eigen::Matrix3d upright = exp_rotation({0, 1.3, 0});
  ASSERT_TRUE(passed.depth({upright, {60, 0, 0}}).has_value());
  EXPECT_FALSE(passed.depth({upright, {60, 0, 30}}).has_value()) << "all of it in front";
}

// Where a surface is large beside the model, as many samples of it tell as of others.
TEST(PassedThrough, ALargeSurfaceIsNotSampledAsFinelyAsASmallModelIs) {
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ(), origin = Eigen::Vector3d::Zero();
  test::Asked asked;
  ContactPair pair;
  pair.on_B = std::make_shared<test::CountedSurface>(make_plane(origin, up, 160), asked);
  pair.on_A = make_plane(origin, -up, 8);
  const PassedThrough passed(pair, 8);
  asked = {};
  const std::optional<double> depth = passed.depth({exp_rotation({0.05, -0.1, 0.3}), {3, 0, -7}});
  ASSERT_TRUE(depth.has_value());
  EXPECT_NEAR(*depth, 7.5, 0.5);
  EXPECT_LT(asked.surfaces, 5000);
}

// A ball beside a ring is in the ring's solid, although most of what faces it is the ring's far side, from the front.
TEST(PassedThrough, ABallBesideAHollowCylinderIsBehind) {
  const Eigen::Vector3d axis = Eigen::Vector3d::UnitZ(), origin = Eigen::Vector3d::Zero();
  ContactPair pair;
  pair.on_B = make_cylinder(origin, axis, 16, false, 13);
  pair.on_A = make_sphere(origin, 12, true);
  for (const double L : {30.0, 150.0}) {
    const PassedThrough passed(pair, L);
    EXPECT_FALSE(passed.depth({exp_rotation({0.1, 0.2, 0.3}), {2, 1, 3}}).has_value())
        << "within it";
    EXPECT_FALSE(passed.depth({exp_rotation({0.1, 0.2, 0.3}), {0, 1, 40}}).has_value())
        << "before its end";
    ASSERT_TRUE(passed.depth({exp_rotation({0.1, 0.2, 0.3}), {130, 1, 0}}).has_value()) << L;
  }
}

// A tube touches the outside of a short cylinder at one place, and runs through its solid near the axis at another, where
// nothing of it faces the wall. Behind a patch of the same shape nobody knows of a solid.
TEST(PassedThrough, ATubeThatTouchesTheWallAndRunsAlongTheAxisIsInTheSolid) {
  const Eigen::Vector3d axis = Eigen::Vector3d::UnitZ(), origin = Eigen::Vector3d::Zero();
  ContactPair pair;
  pair.on_A = make_torus(origin, Eigen::Vector3d::UnitY(), 32, 6, true);
  for (const bool exact : {true, false}) {
    pair.on_B = make_cylinder(origin, axis, 33, true, 14);
    if (!exact)
      pair.on_B = std::make_shared<test::KnownPart>(
          pair.on_B, [](const Eigen::Vector3d& c) { return 7 - std::abs(c.z()); });
    PassedThrough passed(pair, 90, 14);
    // Its hole is about the wall: one side of the tube is outside and touches, the other at the axis.
    const auto depth = passed.depth_of_touching_pose({Eigen::Matrix3d::Identity(), {33, 0, 0}});
    EXPECT_EQ(depth.has_value(), exact);
    if (depth) {
      EXPECT_NEAR(*depth, 33, 6);
    }
    passed.reset();
    EXPECT_FALSE(passed.depth_of_touching_pose({Eigen::Matrix3d::Identity(), {71, 0, 0}}))
        << "all of it outside";
  }
}

// All around a hollow sphere is solid: what lies there as a whole comes near no point of the surface.
TEST(PassedThrough, WhatLiesBeyondAHollowSphereIsBehind) {
  ContactPair pair;
  pair.on_B = make_sphere(Eigen::Vector3d(5, -3, 2), 26, false);
  for (const bool ring : {false, true}) {
    if (ring)
      pair.on_A = make_torus(Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitY(), 24, 9, true);
    else
      pair.on_A = make_sphere(Eigen::Vector3d::Zero(), 20, true);
    PassedThrough passed(pair, 90, 14);
    const auto depth = passed.depth_of_clear_pose({exp_rotation({0.1, 0.2, 0.3}), {80, 10, 0}});
    ASSERT_TRUE(depth.has_value()) << ring;
    EXPECT_NEAR(*depth, ring ? 80 : 70, 10) << ring;
    if (ring) continue;
    passed.reset();
    EXPECT_FALSE(passed.depth_of_clear_pose({exp_rotation({0.1, 0.2, 0.3}), {7, -2, 4}}))
        << "within it";
    pair.on_B = make_sphere(Eigen::Vector3d(5, -3, 2), 26, true);
    EXPECT_FALSE(
        PassedThrough(pair, 90, 14).depth_of_clear_pose({Eigen::Matrix3d::Identity(), {80, 10, 0}}))
        << "beside a solid one";
    pair.on_B = make_sphere(Eigen::Vector3d(5, -3, 2), 26, false);
  }
}

}  // namespace
}  // namespace condyle
