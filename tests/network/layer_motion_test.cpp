/// Motions on elastic layers: a ball on a plane against its closed forms, and the phantom's shank.
/// Points of a ball of radius R pressed into a plane by d: F = π k R d², U = π k R d³/3, with k =
/// 6.321839080459770 N/mm³ of two layers in series.

#include <gtest/gtest.h>

#include <cmath>

#include "condyle/contact/contact_pair.h"
#include "condyle/contact/layer_contact.h"
#include "condyle/network/integrate.h"
#include "condyle/network/motion_lattices.h"
#include "condyle/network/simulate.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/specimen/fit_surfaces.h"
#include "condyle/surface/exact_surfaces.h"
#include "network/integration_options.h"

namespace condyle {
namespace {

constexpr double kBallRadius = 30, kBallMass = 1e-3;  // [mm], [t]
const double kSpring = M_PI * 6.321839080459770 * kBallRadius;

/// A ball over an endless plane, its centre `height` above where it touches.
struct LayeredBall {
  Network network;
  NetworkState state;

  explicit LayeredBall(double height) {
    MassProperties mass;
    mass.mass = kBallMass;
    mass.inertia = 0.4 * kBallMass * kBallRadius * kBallRadius * Eigen::Matrix3d::Identity();
    ContactPair pair;
    pair.name = "pad";
    pair.on_B = make_plane({0, 0, 0}, {0, 0, 1});
    pair.on_A = make_sphere({0, 0, 0}, kBallRadius, true);
    pair.elastic_B = pair.elastic_A = ElasticSurface{10, 0.45, 3};
    pair.mode = ContactMode::kOpen;
    LayerOptions options;
    options.tolerance = 1e-5;
    network.bodies = {{"ball", mass, {0, 0, 0}, false}};
    network.potentials = {{"pad", 0, layer_contact(options)(pair)}};
    state.bodies = {
        {{Eigen::Matrix3d::Identity(), {0, 0, kBallRadius + height}}, {0, 0, 0}, {0, 0, 0}}};
  }

  Motion move(const IntegrationOptions& options) {
    choose_lattices(state.bodies[0].X, network);
    for (;;) {
      Motion motion = integrate(network, state, options);
      if (refine_lattices(motion, network).empty()) return motion;
    }
  }
};

// Thrown at the plane it comes back as fast: it is deepest at d³ = 3 m v²/(2 π k R), and has left
// after 2 d/v ∫ dx/√(1 - x³) = 2 √π Γ(4/3)/Γ(5/6) d/v.
TEST(LayerMotion, BallComesBackAfterTheTimeOfTheClosedForm) {
  const double speed = 300, deepest = std::cbrt(1.5 * kBallMass * speed * speed / kSpring);
  const double time =
      2 * std::sqrt(M_PI) * std::tgamma(4.0 / 3) / std::tgamma(5.0 / 6) * deepest / speed;
  LayeredBall ball(0);
  ball.state.bodies[0].v = {0, 0, -speed};
  const Motion motion = ball.move(options(2 * time, time / 2, 1e-12));
  ASSERT_TRUE(motion.completed) << motion.reason;
  ASSERT_EQ(motion.frames.size(), 5U);
  const auto depth = [&](std::size_t frame) {
    return kBallRadius - motion.frames[frame].state.bodies[0].X.p.z();
  };
  EXPECT_NEAR(depth(1), deepest, 1e-4 * deepest);
  EXPECT_NEAR(depth(2), 0, 1e-3 * deepest);
  EXPECT_NEAR(motion.frames[1].state.bodies[0].v.z(), 0, 1e-3 * speed);
  EXPECT_NEAR(motion.frames[1].energy.layers, kSpring * std::pow(deepest, 3) / 3,
              1e-4 * motion.energy_scale);
  const BodyState& after = motion.frames[4].state.bodies[0];
  EXPECT_NEAR(after.v.z(), speed, 1e-8 * speed);
  EXPECT_NEAR(after.v.head<2>().norm(), 0, 1e-3 * speed);
  EXPECT_LT(motion.largest_imbalance, 1e-8 * motion.energy_scale);
}

// Laid down without speed, a ball of weight w = π k R d² falls to √3 d and comes back after
// 2 √(√3 d/2g) ∫ dx/√(x (1 - x²)), the integral being B(1/4, 1/2)/2.
TEST(LayerMotion, BallThatIsLaidDownOscillates) {
  const double g = 9810, deepest = std::sqrt(3 * g * kBallMass / kSpring);
  const double beta = std::tgamma(0.25) * std::sqrt(M_PI) / std::tgamma(0.75);
  const double period = std::sqrt(deepest / (2 * g)) * beta;
  LayeredBall ball(0);
  ball.network.gravity = {0, 0, -g};
  const Motion motion = ball.move(options(5 * period, period / 2, 1e-11));
  ASSERT_TRUE(motion.completed) << motion.reason;
  ASSERT_EQ(motion.frames.size(), 11U);
  for (std::size_t i = 0; i < motion.frames.size(); ++i) {
    const double depth = kBallRadius - motion.frames[i].state.bodies[0].X.p.z();
    EXPECT_NEAR(depth / deepest, i % 2 == 0 ? 0 : 1, 1e-3) << i;
  }
  EXPECT_LT(motion.largest_imbalance, 1e-7 * motion.energy_scale);
}

// With a damper beside the layer it comes to rest at its depth; what it loses is what was damped.
TEST(LayerMotion, DampedBallComesToRest) {
  const double depth = std::sqrt(9810 * kBallMass / kSpring);
  LayeredBall ball(5);
  ball.network.gravity = {0, 0, -9810};
  LineComponent damper;
  damper.name = "damper";
  damper.from = add_port(ball.network, "above", kGround, {0, 0, 200});
  damper.to = add_port(ball.network, "centre", 0, {0, 0, 0});
  damper.damping = 0.05;
  ball.network.lines.push_back(damper);
  const Motion motion = ball.move(options(0.8, 0.05, 1e-9));
  ASSERT_TRUE(motion.completed) << motion.reason;
  const MotionFrame& end = motion.frames.back();
  EXPECT_NEAR(end.state.bodies[0].v.norm(), 0, 1e-4);
  EXPECT_NEAR(kBallRadius - end.state.bodies[0].X.p.z(), depth, 1e-3 * depth);
  EXPECT_NEAR(end.dissipated, 9810 * kBallMass * (5 + depth) - end.energy.layers,
              2e-6 * motion.energy_scale);
  EXPECT_LT(motion.largest_imbalance, 1e-6 * motion.energy_scale);
}

Scene layered_pendulum(double modulus) {
  Scene scene = read_scene(CONDYLE_SOURCE_DIR "/data/phantom/pendulum.toml");
  for (SurfaceDescription& surface : scene.surfaces)
    surface.elastic = ElasticSurface{modulus, 0.45, 3};
  for (ContactDescription& contact : scene.contacts) contact.layer = LayerOptions();
  scene.simulation->time = 0.2;
  scene.simulation->tolerance = 1e-8;
  return scene;
}

// The phantom's shank swings on its layers, from an equilibrium of theirs; frames tell pressures,
// and no energy is lost but in what is viscous.
TEST(LayerMotion, ThePhantomsShankSwings) {
  const Scene scene = layered_pendulum(10);
  const Simulation motion = simulate(scene, fit_surfaces(scene));
  ASSERT_TRUE(motion.motion.completed) << motion.motion.reason;
  EXPECT_LT(motion.motion.largest_imbalance, 1e-6 * motion.motion.energy_scale);
  EXPECT_GT(motion.poses.back().joint.flexion, motion.poses.front().joint.flexion + 0.05);
  for (const PoseResult& pose : motion.poses) {
    EXPECT_TRUE(pose.converged()) << pose.reason;
    double energy = 0;
    for (const ContactResult& contact : pose.contacts) {
      ASSERT_TRUE(contact.layer) << pose.value;
      EXPECT_LT(contact.layer->error, 5e-3);
      EXPECT_FALSE(contact.pressures.empty());
      energy += contact.layer->energy;
    }
    const auto frame = static_cast<std::size_t>(&pose - motion.poses.data());
    EXPECT_NEAR(motion.motion.frames[frame].energy.layers, energy, 1e-6 * energy);
  }
}

// Started with a velocity of flexion: what is pressed keeps its depth at first.
TEST(LayerMotion, AStartWithAVelocityLeavesTheDepths) {
  Scene scene = layered_pendulum(10);
  scene.simulation->flexion_velocity = 1;
  scene.simulation->time = 2e-4;
  scene.simulation->rate = 1e4;
  const Simulation motion = simulate(scene, fit_surfaces(scene));
  ASSERT_TRUE(motion.motion.completed) << motion.motion.reason;
  const auto deepest = [&](std::size_t frame, std::size_t contact) {
    return motion.poses[frame].contacts[contact].layer->deepest;
  };
  for (const std::size_t contact : {0, 1})
    EXPECT_NEAR(deepest(1, contact), deepest(0, contact), 2.5e-4) << contact;
  EXPECT_NEAR(motion.poses[1].joint.flexion - motion.poses[0].joint.flexion, 1e-4, 2e-6);
}

}  // namespace
}  // namespace condyle
