/// Bodies that nothing holds, against closed solutions.

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "condyle/input_error.h"
#include "condyle/math/rotation.h"
#include "condyle/network/integrate.h"
#include "network/integration_options.h"
#include "support/jacobi.h"
#include "support/random.h"

namespace condyle {
namespace {

/// 2 kg with principal inertias I1 < I2 < I3 along x, y, z of its frame.
MassProperties asymmetric() {
  MassProperties mass;
  mass.mass = 2e-3;
  mass.inertia = Eigen::Vector3d(3, 5, 7).asDiagonal();
  return mass;
}

Network one_body(const MassProperties& mass, const Eigen::Vector3d& reference = {0, 0, 0}) {
  Network network;
  network.bodies = {{"body", mass, reference, false}};
  return network;
}

NetworkState spinning(const Eigen::Vector3d& omega) {
  NetworkState state;
  state.bodies = {{{}, {0, 0, 0}, omega}};
  return state;
}

/// Body-frame angular velocity for M² > 2 E I2 and ω2 = 0 at the start [Landau and Lifshitz 1976,
/// 37.8-37.12].
Eigen::Vector3d free_rotation(const Eigen::Vector3d& I, const Eigen::Vector3d& start, double t) {
  const double E2 = I.dot(start.cwiseAbs2()), M2 = I.cwiseProduct(start).squaredNorm();
  const double a = E2 * I[2] - M2, b = M2 - E2 * I[0];
  const double tau = t * std::sqrt((I[2] - I[1]) * b / I.prod());
  const double k = std::sqrt((I[1] - I[0]) * a / ((I[2] - I[1]) * b));
  const test::Jacobi j = test::jacobi(tau, k);
  return {std::sqrt(a / (I[0] * (I[2] - I[0]))) * j.cn,
          std::sqrt(a / (I[1] * (I[2] - I[1]))) * j.sn,
          std::sqrt(b / (I[2] * (I[2] - I[0]))) * j.dn};
}

TEST(FreeBody, AsymmetricBodyFollowsJacobisFunctions) {
  const Network network = one_body(asymmetric());
  const Eigen::Vector3d start(4, 0, 6);
  const Motion motion = integrate(network, spinning(start), options(10, 0.5, 1e-12));
  ASSERT_TRUE(motion.completed) << motion.reason;
  ASSERT_EQ(motion.frames.size(), 21U);
  const Eigen::Vector3d I(3, 5, 7);
  for (const MotionFrame& frame : motion.frames) {
    const BodyState& body = frame.state.bodies[0];
    const Eigen::Vector3d expected = free_rotation(I, start, frame.state.t);
    // 60 turns at a tolerance of 1e-12: errors add up to some 1e-9.
    EXPECT_LT((body.X.R.transpose() * body.omega - expected).norm(), 1e-8) << frame.state.t;
  }
}

// A table of a driver may have more points than contacts may have events, in any order.
TEST(FreeBody, GoesThroughAnyNumberOfJumpsInOneFrame) {
  const Network network = one_body(asymmetric());
  IntegrationOptions jumping = options(1, 1, 1e-10);
  for (int k = 1500; k > 0; --k) jumping.breaks.push_back(k / 1600.0);
  const Motion smooth = integrate(network, spinning({4, 0, 6}), options(1, 1, 1e-10)),
               motion = integrate(network, spinning({4, 0, 6}), jumping);
  ASSERT_TRUE(motion.completed) << motion.reason;
  ASSERT_EQ(motion.frames.size(), 2U);
  // 1500 restarts at a tolerance of 1e-10.
  EXPECT_LT(
      (motion.frames[1].state.bodies[0].omega - smooth.frames[1].state.bodies[0].omega).norm(),
      1e-5);
}

// Close to the separatrix M² = 2 E I2: the body turns over again and again about its middle axis.
TEST(FreeBody, TurnsOverAboutItsMiddleAxis) {
  const Network network = one_body(asymmetric());
  // With ω2 = 0, M² = 2 E I2 where I1 (I2 - I1) ω1² = I3 (I3 - I2) ω3²; a little beyond.
  const double ratio = std::sqrt(7.0 * 2 / (3.0 * 2));
  const Eigen::Vector3d start(ratio * 5 * (1 - 1e-4), 0, 5), I(3, 5, 7);
  const Motion motion = integrate(network, spinning(start), options(5, 0.05, 1e-12));
  ASSERT_TRUE(motion.completed) << motion.reason;
  double least = 0, greatest = 0;
  for (const MotionFrame& frame : motion.frames) {
    const BodyState& body = frame.state.bodies[0];
    const Eigen::Vector3d w = body.X.R.transpose() * body.omega;
    // The unstable axis makes e^(5 t) of every error while the body turns over.
    EXPECT_LT((w - free_rotation(I, start, frame.state.t)).norm(), 1e-5);
    least = std::min(least, w.y());
    greatest = std::max(greatest, w.y());
  }
  EXPECT_GT(greatest, 5);  // spins about +y, then about -y
  EXPECT_LT(least, -5);
}

// The axis of a free symmetric top goes round its angular momentum at the rate L / I1.
TEST(FreeBody, SymmetricTopPrecesses) {
  MassProperties mass = asymmetric();
  mass.inertia = Eigen::Vector3d(4, 4, 7).asDiagonal();
  const Eigen::Vector3d omega(2, 0, 5), L(8, 0, 35);
  const Motion motion = integrate(one_body(mass), spinning(omega), options(5, 0.25, 2e-13));
  for (const MotionFrame& frame : motion.frames) {
    const Eigen::Vector3d axis = frame.state.bodies[0].X.R.col(2);
    const Eigen::Vector3d expected = exp_rotation(frame.state.t * L / 4) * Eigen::Vector3d::UnitZ();
    EXPECT_LT((axis - expected).norm(), 1e-9) << frame.state.t;
  }
}

// Thrown under gravity, told from a port far from the mass centre: the centre flies a parabola and
// the body turns as if nothing pulled.
TEST(FreeBody, MovesTheSameToldFromAnyReferencePort) {
  test::Random random(8);
  MassProperties mass = asymmetric();
  mass.center = {10, -20, 30};
  const Eigen::Vector3d omega(4, 1, 6), v_G(300, 500, -100), gravity(0, -9810, 0);
  std::vector<RigidTransform> ends;
  for (const Eigen::Vector3d& reference : {mass.center, Eigen::Vector3d(-40, 25, 60)}) {
    Network network = one_body(mass, reference);
    network.gravity = gravity;
    NetworkState state = spinning(omega);
    state.bodies[0].v = v_G + omega.cross(reference - mass.center);
    const Motion motion = integrate(network, state, options(1, 0.1, 1e-12));
    ASSERT_TRUE(motion.completed);
    ends.push_back(motion.frames.back().state.bodies[0].X);
    EXPECT_LT((ends.back() * mass.center - (mass.center + v_G + gravity / 2)).norm(), 1e-7);
    EXPECT_LT(motion.largest_imbalance, 1e-10 * motion.energy_scale);
  }
  EXPECT_LT((ends[0].R - ends[1].R).norm(), 1e-9);
}

// Each tenth of the tolerance brings the end nearer, by at least a factor of four on the average.
TEST(FreeBody, ErrorsFollowTheTolerance) {
  const Eigen::Vector3d start(4, 0, 6), I(3, 5, 7), exact = free_rotation(I, start, 3);
  std::vector<double> errors;
  for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10}) {
    const Motion motion =
        integrate(one_body(asymmetric()), spinning(start), options(3, 3, tolerance));
    const BodyState& body = motion.frames.back().state.bodies[0];
    errors.push_back((body.X.R.transpose() * body.omega - exact).norm());
  }
  EXPECT_GT(errors.front() / errors.back(), std::pow(4, 6));
  EXPECT_LT(errors.back(), 2e-7);
}

TEST(FreeBody, WithoutMassItHasNoMotion) {
  Network network;
  network.bodies = {{"tibia", {}, {0, 0, 0}, false}};
  EXPECT_THROW((void)integrate(network, spinning({0, 0, 0}), {}), InputError);
}

}  // namespace
}  // namespace condyle
