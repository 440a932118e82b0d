/// Contacts that slide, open and strike.

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>

#include "condyle/math/rotation.h"
#include "condyle/network/contact_changes.h"
#include "condyle/network/integrate.h"
#include "condyle/surface/exact_surfaces.h"
#include "network/gravity.h"
#include "network/integration_options.h"

namespace condyle {
namespace {

/// A ball of radius 10 and its contact with one surface of the ground.
struct Ball {
  Network network;
  NetworkState state;

  Ball(std::shared_ptr<const Surface> ground, const Eigen::Vector3d& center) {
    MassProperties mass;
    mass.mass = 1e-3;
    mass.inertia = 0.04 * Eigen::Matrix3d::Identity();
    network.gravity = kGravity;
    network.bodies = {{"ball", mass, {0, 0, 0}, false}};
    network.contacts = {{"contact", 0, ground, make_sphere({0, 0, 0}, 10, true), true}};
    state.bodies = {{{Eigen::Matrix3d::Identity(), center}, {0, 0, 0}, {0, 0, 0}}};
    state.contacts.resize(1);
    state.contacts[0].places.on_B = ground->seed(center);
  }
  void touch_at(const Eigen::Vector3d& point) {
    state.contacts[0].places.on_B = network.contacts[0].on_ground->seed(point);
    state.contacts[0].places.on_A =
        network.contacts[0].on_body->seed(state.bodies[0].X.inverse() * point);
  }
};

// From rest at θ0 a bead leaves the sphere where cos θ = 2/3 cos θ0, whatever the radii.
TEST(ContactMotion, BeadLeavesTheSphereAtTwoThirds) {
  const double start = 0.1, path = 60;
  Ball ball(make_sphere({0, 0, 0}, 50, true), {path * std::sin(start), path * std::cos(start), 0});
  ball.touch_at(ball.state.bodies[0].X.p * 5 / 6);
  ball.state.contacts[0].closed = true;
  const Motion motion = integrate(ball.network, ball.state, options(0.4, 0.001, 1e-10));
  ASSERT_TRUE(motion.completed) << motion.reason;
  ASSERT_EQ(motion.events.size(), 1U);
  EXPECT_FALSE(motion.events[0].closing);
  double last_height = 0;
  for (const MotionFrame& frame : motion.frames) {
    const Eigen::Vector3d& p = frame.state.bodies[0].X.p;
    if (!frame.state.contacts[0].closed) break;
    last_height = p.y() / path;
    // Normal force: m g (3 cos θ - 2 cos θ0).
    EXPECT_NEAR(frame.contact_force[0], 9.81 * (3 * p.y() / path - 2 * std::cos(start)), 1e-6);
    EXPECT_NEAR(p.norm(), path, 1e-9);
  }
  EXPECT_NEAR(last_height, 2.0 / 3 * std::cos(start), 0.03);  // the frame before
  // Exactly at the event: energy gives the speed, the fall from there is free.
  IntegrationOptions until = options(motion.events[0].t, motion.events[0].t, 1e-10);
  const Motion again = integrate(ball.network, ball.state, until);
  // The top is unstable: an error of 1e-10 at the start has grown a thousandfold.
  EXPECT_NEAR(again.frames.back().state.bodies[0].X.p.y() / path, 2.0 / 3 * std::cos(start), 1e-6);
  EXPECT_LT(motion.largest_imbalance, 1e-7 * motion.energy_scale);
}

// Which of them stay closed is found among all their subsets.
TEST(ContactMotion, TooManyContactsAtOneMomentEndAMotionByName) {
  for (const std::size_t contacts : {kMostTouching, kMostTouching + 1}) {
    Ball ball(make_plane({0, 0, 0}, {0, 1, 0}), {0, 10, 0});
    ball.touch_at({0, 0, 0});
    ball.network.contacts.assign(contacts, ball.network.contacts.front());
    ball.state.contacts.assign(contacts, ball.state.contacts.front());
    ball.network.gravity = {0, 0, 0};
    const Motion motion = integrate(ball.network, ball.state, options(0.01, 0.01, 1e-8));
    const bool too_many = contacts > kMostTouching;
    EXPECT_EQ(motion.completed, !too_many) << motion.reason;
    EXPECT_EQ(motion.reason, too_many ? "at 0 s: more than 16 contacts touch at one moment" : "");
  }
}

// Inside a cylinder without friction a ball is a pendulum of length R - r; too slow for the loop
// it comes loose where v² = g l cos.
TEST(ContactMotion, BallComesLooseInACylinder) {
  const double l = 40, speed = std::sqrt(4.0 * 9810 * l);  // v0² = 4 g l: loose, for 2 < 4 < 5
  Ball ball(make_cylinder({0, 0, 0}, {0, 0, 1}, 50, false), {0, -l, 0});
  ball.touch_at({0, -50, 0});
  ball.state.contacts[0].closed = true;
  ball.state.bodies[0].v = {speed, 0, 0};
  const Motion first = integrate(ball.network, ball.state, options(0.3, 0.001, 1e-10));
  ASSERT_FALSE(first.events.empty());
  EXPECT_FALSE(first.events[0].closing);
  const double t = first.events[0].t;
  const Motion motion = integrate(ball.network, ball.state, options(t, t, 1e-10));
  // Height over the axis h: v² = v0² - 2 g (l + h) and v² = g h, so h = (4 - 2) l / 3.
  EXPECT_NEAR(motion.frames.back().state.bodies[0].X.p.y(), 2 * l / 3, 1e-4);
}

// Dropped by h, a ball bounces to e² h, e⁴ h ...; what is lost at each impact is booked.
TEST(ContactMotion, DroppedBallBounces) {
  Ball ball(make_plane({0, 0, 0}, {0, 1, 0}), {0, 110, 0});
  ball.touch_at({0, 0, 0});
  ball.state.contacts[0].places.on_A = ball.network.contacts[0].on_body->seed({0, -10, 0});
  IntegrationOptions o = options(1.2, 0.01, 1e-10);
  o.restitution = 0.6;
  o.least_rebound = 5;
  const Motion motion = integrate(ball.network, ball.state, o);
  ASSERT_TRUE(motion.completed) << motion.reason;
  ASSERT_GE(motion.events.size(), 8U);
  const double fall = std::sqrt(2 * 100 / 9810.0), v = std::sqrt(2 * 9810 * 100.0);
  EXPECT_NEAR(motion.events[0].t, fall, 1e-8);
  EXPECT_NEAR(motion.events[0].speed, v, 1e-5);
  double t = fall, e = 1;
  for (std::size_t k = 1; k < 6; ++k) {
    e *= 0.6;
    t += 2 * fall * e;
    EXPECT_NEAR(motion.events[k].t, t, 1e-6) << k;
    EXPECT_NEAR(motion.events[k].speed, e * v, 1e-4) << k;
  }
  EXPECT_LT(motion.largest_imbalance, 1e-7 * motion.energy_scale);
  const MotionFrame& end = motion.frames.back();  // at rest
  EXPECT_TRUE(end.state.contacts[0].closed);
  EXPECT_NEAR(end.contact_force[0], 9.81, 1e-6);
  EXPECT_NEAR(end.dissipated, 9.81 * 100, 1e-4);
}

// Without restitution the first impact ends the fall.
TEST(ContactMotion, PlasticImpactStays) {
  Ball ball(make_plane({0, 0, 0}, {0, 1, 0}), {0, 30, 0});
  ball.touch_at({0, 0, 0});
  ball.state.contacts[0].places.on_A = ball.network.contacts[0].on_body->seed({0, -10, 0});
  ball.state.bodies[0].v = {40, 0, 0};
  const Motion motion = integrate(ball.network, ball.state, options(0.3, 0.01, 1e-9));
  ASSERT_EQ(motion.events.size(), 1U);
  const BodyState& body = motion.frames.back().state.bodies[0];
  EXPECT_NEAR(body.v.x(), 40, 1e-7);
  EXPECT_NEAR(body.X.p.y(), 10, 1e-9);
}

}  // namespace
}  // namespace condyle
