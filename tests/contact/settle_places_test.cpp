/// Two places settle where the gap is stationary, whatever the gap.

#include "condyle/contact/settle_places.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>

#include "condyle/math/rotation.h"
#include "condyle/surface/exact_surfaces.h"

namespace condyle {
namespace {

// From the saddle between two hills of a polynomial, and from a little beside it.
TEST(SettlePlaces, IsNotHeldByASaddle) {
  const double d = 1.2, a = 0.002 / std::pow(d, 4);
  const auto hills = make_polynomial(
      {0, 0, 0}, Eigen::Matrix3d::Identity(),
      {{0, 0, -a * std::pow(d, 4)}, {2, 0, 2 * a * d * d}, {4, 0, -a}, {0, 2, -0.02}}, true, 8);
  const auto plane = make_plane({0, 0, 0}, {0, 0, -1});
  const RigidTransform X{Eigen::Matrix3d::Identity(), {0, 0, 0.1}};
  for (const double x : {1e-3, -0.1, 0.3}) {
    const Eigen::Vector3d start(x, 0.2, 0);
    ContactPlaces places{hills->closest(start, hills->seed(start)),
                         plane->closest(start, plane->seed(start))};
    ContactLinearization at;
    ASSERT_EQ(settle_places({*hills, *plane}, X, {5, true}, places, at), Settled::kThere) << x;
    const Eigen::Vector3d found = hills->evaluate(places.on_B).c;
    EXPECT_NEAR(found.x(), std::copysign(d, x), 1e-9);
    EXPECT_NEAR(found.y(), 0, 1e-9);
  }
}

/// A ball of 10 mm in a socket of 50 mm, its centre at `center`: the gap is least where the line
/// from the socket's centre leads.
class BallInASocket : public testing::Test {
 protected:
  ContactPlaces places_at(const Eigen::Vector3d& direction) const {
    return {socket->seed(50 * direction), ball->seed(10 * direction)};
  }
  Settled settle(const Eigen::Vector3d& center, const Settling& how) {
    return settle_places({*socket, *ball}, {Eigen::Matrix3d::Identity(), center}, how, places, at);
  }
  const std::unique_ptr<Surface> socket = make_sphere({0, 0, 0}, 50, false);
  const std::unique_ptr<Surface> ball = make_sphere({0, 0, 0}, 10, true);
  const Eigen::Vector3d down{0, -1, 0};
  const Eigen::Vector3d aside = Eigen::Vector3d(0.2, -1, 0.1).normalized();
  ContactPlaces places;
  ContactLinearization at;
};

// Gaps of 0 to 30 mm; at 40 mm, the centre of the socket, every place is as near.
TEST_F(BallInASocket, SettlesAtAnyGap) {
  for (const double gap : {0.0, 5.0, 20.0, 30.0}) {
    places = places_at(aside);
    ASSERT_EQ(settle((40 - gap) * down, {50, true}), Settled::kThere) << gap;
    EXPECT_NEAR(at.gap(), gap, 1e-12);
    EXPECT_LT((at.B.c - 50 * down).norm(), 1e-9) << gap;
    EXPECT_LT((at.A.c - 10 * down).norm(), 1e-9) << gap;
    EXPECT_TRUE(are_opposite(at));
  }
}

// Above the centre the place below is the farthest: stationary, but no minimum.
TEST_F(BallInASocket, LeavesTheFarSideForTheNearOne) {
  const Eigen::Vector3d center(0, 15, 0);
  places = places_at(aside);
  ASSERT_EQ(settle(center, {1000, true}), Settled::kThere);
  EXPECT_NEAR(at.gap(), 50 - 15 - 10, 1e-12);
  EXPECT_LT((at.B.c + 50 * down).norm(), 1e-9);
}

TEST_F(BallInASocket, SaysWhatBecameOfIt) {
  places = places_at(aside);
  EXPECT_EQ(settle(30 * down, {5}), Settled::kLost);  // 11 mm away
  // From places opposite each other the first step would be exact.
  places = {places_at(aside).on_B, places_at(Eigen::Vector3d(-0.1, -1, 0.2).normalized()).on_A};
  EXPECT_EQ(settle(30 * down, {200, true, 9.9}), Settled::kAbove);
  places = places_at(aside);
  EXPECT_EQ(settle(30 * down, {200, true, 10.1}), Settled::kThere);
  places = places_at(aside);
  EXPECT_EQ(settle(Eigen::Vector3d::Constant(NAN), {50}), Settled::kLost);
}

// A roller tilted over a floor: across its line it settles, along it little moves.
TEST(SettlePlaces, SettlesAcrossATiltedLine) {
  const auto floor = make_plane({0, 0, 0}, {0, 0, 1});
  const auto roll = make_cylinder({0, 0, 0}, {1, 0, 0}, 10, true);
  const double tilt = 0.02;
  const RigidTransform X{exp_rotation({0, tilt, 0}), {0, 0, 11}};
  ContactPlaces places{floor->seed({4, 1, 0}), roll->seed({4, 3, -9})};
  ContactLinearization at;
  ASSERT_EQ(settle_places({*floor, *roll}, X, {5}, places, at), Settled::kThere);
  EXPECT_NEAR(at.B.c.x(), 4, tilt);  // the first normals are off sideways by 0.3
  EXPECT_LT((at.g - at.gap() * at.B.n).norm(), 1e-10);
  EXPECT_NEAR(at.m.y(), 0, 1e-10);
  EXPECT_NEAR(at.h.norm(), 2 * std::sin(tilt / 2), 1e-10);
  EXPECT_FALSE(are_opposite(at));
  EXPECT_EQ(settle_places({*floor, *roll}, X, {5, true}, places, at), Settled::kLost);
}

}  // namespace
}  // namespace condyle
