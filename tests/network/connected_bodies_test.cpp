/// Springs, dampers, joints and drivers, against closed solutions and balances.

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>

#include "condyle/input_error.h"
#include "condyle/math/rotation.h"
#include "condyle/network/integrate.h"
#include "condyle/network/network_equations.h"
#include "network/gravity.h"
#include "network/integration_options.h"
#include "support/random.h"

namespace condyle {
namespace {

MassProperties rod() {
  MassProperties mass;
  mass.mass = 4e-3;
  mass.center = {0, -180, 0};
  mass.inertia = Eigen::Vector3d(50, 8, 55).asDiagonal();
  return mass;
}

ForceLaw spring(double stiffness, double slack) {
  return PolynomialLaw{{-stiffness * slack, stiffness}, false};
}

/// Hanging from the ground by a ball joint at its origin, turned by `angle` about z.
struct Pendulum {
  Network network;
  NetworkState state;

  explicit Pendulum(double angle, const Eigen::Vector3d& reference = rod().center) {
    network.gravity = kGravity;
    network.bodies = {{"rod", rod(), reference, false}};
    const int pivot = add_port(network, "pivot", 0, {0, 0, 0});
    const int hook = add_port(network, "hook", kGround, {0, 0, 0});
    network.joints = {{"hinge", hook, pivot}};
    state.bodies = {{{exp_rotation({0, 0, angle}), {0, 0, 0}}, {0, 0, 0}, {0, 0, 0}}};
  }
};

double angle_of(const RigidTransform& X) { return std::atan2(X.R(1, 0), X.R(0, 0)); }

/// Σ x.y over all edges of the graph, with the bodies' own terminal equations.
void expect_tellegen(const Network& network, const MotionFrame& frame) {
  NetworkEquations equations(network);
  NetworkState state = frame.state;
  ASSERT_TRUE(equations.assemble(state) && equations.solve());
  EdgeVariables x, y;
  equations.edge_variables(x, y);
  const TellegenSum power = tellegen_sum(x, y);
  double weights = 0;  // the power of gravity, which the bodies hold within themselves
  for (const BodyState& body : state.bodies) weights += 4e-3 * 9810 * body.v.norm();
  EXPECT_LE(std::abs(power.sum), 1e-12 * (power.scale + weights)) << frame.state.t;
}

// T = 4 sqrt(I / m g d) K(sin(θ/2)), I about the pivot.
TEST(ConnectedBodies, CompoundPendulumHasThePeriodOfTheEllipticIntegral) {
  const double angle = 2.0, d = 180, m = rod().mass, I = 55 + m * d * d;
  const double period = 4 * std::sqrt(I / (m * 9810 * d)) * std::comp_ellint_1(std::sin(angle / 2));
  for (const Eigen::Vector3d& reference : {rod().center, Eigen::Vector3d(30, 10, -20)}) {
    const Pendulum pendulum(angle, reference);
    const Motion motion =
        integrate(pendulum.network, pendulum.state, options(period, period / 4, 1e-11));
    ASSERT_TRUE(motion.completed) << motion.reason;
    EXPECT_NEAR(angle_of(motion.frames[1].state.bodies[0].X), 0, 1e-7);
    EXPECT_NEAR(angle_of(motion.frames[2].state.bodies[0].X), -angle, 1e-7);
    EXPECT_NEAR(angle_of(motion.frames[4].state.bodies[0].X), angle, 1e-7);
    for (const MotionFrame& frame : motion.frames) {
      EXPECT_LT(frame.state.bodies[0].X.p.norm(), 1e-11);  // the pivot stays
      expect_tellegen(pendulum.network, frame);
    }
  }
}

// x = e^(-δt) (cos ωt + δ/ω sin ωt) x0, δ = c/2m, ω² = k/m - δ².
TEST(ConnectedBodies, MassSpringDamperDiesAway) {
  const double m = 1e-3, k = 0.4, c = 2e-3, x0 = 5, slack = 50;
  Network network;
  MassProperties mass;
  mass.mass = m;
  network.bodies = {{"bob", mass, {0, 0, 0}, true}};
  const int bob = add_port(network, "bob", 0, {0, 0, 0});
  const int wall = add_port(network, "wall", kGround, {-slack, 0, 0});
  network.lines = {{"spring", wall, bob, spring(k, slack), 0, 0}, {"damper", wall, bob, {}, c, 0}};
  NetworkState state;
  state.bodies = {{{Eigen::Matrix3d::Identity(), {x0, 0, 0}}, {0, 0, 0}, {0, 0, 0}}};
  const Motion motion = integrate(network, state, options(2, 0.1, 1e-12));
  ASSERT_TRUE(motion.completed) << motion.reason;
  const double delta = c / (2 * m), omega = std::sqrt(k / m - delta * delta);
  for (const MotionFrame& frame : motion.frames) {
    const double t = frame.state.t;
    const double x =
        x0 * std::exp(-delta * t) * (std::cos(omega * t) + delta / omega * std::sin(omega * t));
    EXPECT_NEAR(frame.state.bodies[0].X.p.x(), x, 1e-8);
    expect_tellegen(network, frame);
  }
  EXPECT_LT(motion.largest_imbalance, 1e-9 * motion.energy_scale);
  EXPECT_GT(motion.frames.back().dissipated, 0.9 * k * x0 * x0 / 2);
}

// Shaken wall: x = a (k/m) / (k/m - Ω²) (sin Ωt - Ω/ω sin ωt) from rest.
TEST(ConnectedBodies, AcrossDriverShakesAMass) {
  const double m = 1e-3, k = 0.4, slack = 50, a = 2, frequency = 12;
  Network network;
  MassProperties mass;
  mass.mass = m;
  network.bodies = {{"bob", mass, {0, 0, 0}, true}};
  const int bob = add_port(network, "bob", 0, {0, 0, 0});
  const int wall = add_port(network, "wall", kNoBody, {0, 0, 0});
  network.lines = {{"spring", wall, bob, spring(k, slack), 0, 0}};
  network.motions = {{"shaker", wall, [=](double t) -> DrivenPoint {
                        const double s = std::sin(frequency * t), c = std::cos(frequency * t);
                        return {{a * s - slack, 0, 0},
                                {a * frequency * c, 0, 0},
                                {-a * frequency * frequency * s, 0, 0}};
                      }}};
  NetworkState state;
  state.bodies.resize(1);
  const Motion motion = integrate(network, state, options(2, 0.1, 1e-12));
  ASSERT_TRUE(motion.completed) << motion.reason;
  const double w = std::sqrt(k / m);
  for (const MotionFrame& frame : motion.frames) {
    const double t = frame.state.t;
    const double x = a * w * w / (w * w - frequency * frequency) *
                     (std::sin(frequency * t) - frequency / w * std::sin(w * t));
    EXPECT_NEAR(frame.state.bodies[0].X.p.x(), x, 1e-8);
    expect_tellegen(network, frame);
  }
  EXPECT_LT(motion.largest_imbalance, 1e-9 * motion.energy_scale);
  EXPECT_GT(std::abs(motion.frames.back().driver_work), 0.01);
}

// Two rods, the second hung from the first, thrown in space: 10 s of chaos.
TEST(ConnectedBodies, DoublePendulumKeepsItsEnergy) {
  Pendulum pendulum(1.2);
  Network& network = pendulum.network;
  network.bodies.push_back({"second", rod(), rod().center, false});
  const int foot = add_port(network, "foot", 0, {0, -360, 0});
  const int head = add_port(network, "head", 1, {0, 0, 0});
  network.joints.push_back({"knee", foot, head});
  const RigidTransform X = pendulum.state.bodies[0].X;
  pendulum.state.bodies.push_back(
      {{exp_rotation({0.4, 0.3, -0.5}), X * Eigen::Vector3d(0, -360, 0)}, {0, 0, 0}, {0, 0, 0}});
  const Motion motion = integrate(network, pendulum.state, options(10, 0.1, 1e-12));
  ASSERT_TRUE(motion.completed) << motion.reason;
  EXPECT_LT(motion.largest_imbalance, 1e-8 * motion.energy_scale);
  EXPECT_GT(motion.energy_scale, 1000);
  for (std::size_t i = 0; i < motion.frames.size(); i += 20)
    expect_tellegen(network, motion.frames[i]);
}

// A pendulum whose pivot is moved: the driver's work is what energy appears.
TEST(ConnectedBodies, ADrivenPortOfABodyFollowsAndItsWorkIsBooked) {
  Pendulum pendulum(0.5);
  pendulum.network.joints.clear();
  pendulum.network.motions = {{"hand", 0, [](double t) -> DrivenPoint {
                                 const Eigen::Vector3d a(30, 10, 20);
                                 return {a * std::sin(7 * t) - a * 7 * t,
                                         7 * a * std::cos(7 * t) - 7 * a,
                                         -49 * a * std::sin(7 * t)};
                               }}};
  const Motion motion = integrate(pendulum.network, pendulum.state, options(3, 0.1, 1e-12));
  ASSERT_TRUE(motion.completed) << motion.reason;
  for (const MotionFrame& frame : motion.frames) {
    const Eigen::Vector3d expected = pendulum.network.motions[0].motion(frame.state.t).position;
    EXPECT_LT((frame.state.bodies[0].X.p - expected).norm(), 1e-9);
    expect_tellegen(pendulum.network, frame);
  }
  EXPECT_LT(motion.largest_imbalance, 1e-8 * motion.energy_scale);
  EXPECT_GT(std::abs(motion.frames.back().driver_work), 100);
}

// No gravity, no ground: two bodies tied by springs keep linear and angular momentum.
TEST(ConnectedBodies, MomentaAreKept) {
  test::Random random(21);
  Network network;
  network.bodies = {{"a", rod(), random.vector(50), false}, {"b", rod(), random.vector(50), false}};
  for (int i = 0; i < 3; ++i) {
    const int p = add_port(network, "p", 0, random.vector(60));
    const int q = add_port(network, "q", 1, random.vector(60));
    network.lines.push_back({"spring", p, q, spring(2, 40), 1e-3, 0});
  }
  NetworkState state;
  for (int i = 0; i < 2; ++i)
    state.bodies.push_back({random.pose(100), random.vector(300), random.vector(3)});
  const Motion motion = integrate(network, state, options(3, 0.1, 1e-12));
  ASSERT_TRUE(motion.completed) << motion.reason;
  const auto momenta = [&](const MotionFrame& frame) {
    Vector6 h = Vector6::Zero();
    for (std::size_t b = 0; b < 2; ++b) {
      const BodyState& body = frame.state.bodies[b];
      const MassProperties& mass = *network.bodies[b].mass;
      const Eigen::Vector3d r = body.X.R * (mass.center - network.bodies[b].reference);
      const Eigen::Vector3d p = mass.mass * (body.v + body.omega.cross(r));
      h.head<3>() += p;
      h.tail<3>() += (body.X * mass.center).cross(p) +
                     body.X.R * mass.inertia * body.X.R.transpose() * body.omega;
    }
    return h;
  };
  const Vector6 first = momenta(motion.frames.front());
  for (const MotionFrame& frame : motion.frames) {
    const Vector6 change = momenta(frame) - first;
    EXPECT_LT(change.head<3>().norm(), 1e-9 * first.head<3>().norm());
    EXPECT_LT(change.tail<3>().norm(), 1e-9 * first.tail<3>().norm());
  }
  EXPECT_LT(motion.largest_imbalance, 1e-8 * motion.energy_scale);
}

TEST(ConnectedBodies, AStartThatViolatesItsConstraintsIsRefused) {
  Pendulum pendulum(1);
  pendulum.state.bodies[0].X.p = {0, 2, 0};
  try {
    (void)integrate(pendulum.network, pendulum.state, {});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("\"hinge\" is 2 off at the start"), std::string::npos)
        << error.what();
  }
}

TEST(ConnectedBodies, ANodeThatOnlySpringsHoldIsRefused) {
  Network network;
  network.bodies = {{"rod", rod(), rod().center, false}};
  const int foot = add_port(network, "foot", 0, {0, -360, 0});
  const int knot = add_port(network, "knot", kNoBody, {0, 0, 0});
  network.lines = {{"thread", foot, knot, spring(1, 10), 0, 0}};
  EXPECT_THROW(NetworkEquations{network}, InputError);
  network.motions = {{"hand", knot, {}}, {"other hand", knot, {}}};
  EXPECT_THROW(NetworkEquations{network}, InputError);  // a loop of across drivers
}

}  // namespace
}  // namespace condyle
