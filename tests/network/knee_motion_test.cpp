/// A knee with mass: two contacts, eight ligaments.

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <functional>
#include <vector>

#include "condyle/equilibrium/equilibrium_solver.h"
#include "condyle/equilibrium/model_covers.h"
#include "condyle/network/drive.h"
#include "condyle/network/integrate.h"
#include "condyle/network/knee_network.h"
#include "condyle/network/network_equations.h"
#include "condyle/network/simulate.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/specimen/fit_surfaces.h"
#include "support/leg.h"
#include "support/quadric_knee.h"
#include "support/two_feet.h"

namespace condyle {
namespace {

EquilibriumState equilibrium(double load_scale) {
  Model model = test::quadric_knee();
  model.loads[0].scale = load_scale;
  EquilibriumSolver solver(model);
  EXPECT_TRUE(solver.solve().converged());
  return solver.state();
}

// Compressed by half as much again and let go, with viscous ligaments, it comes to rest where the
// engine says it is in equilibrium.
TEST(KneeMotion, ComesToRestAtTheEnginesPose) {
  const Model model = test::quadric_knee();
  KneeNetwork knee = make_knee_network(model, test::leg());
  for (LineComponent& line : knee.network.lines) line.viscous_time = 0.05;
  IntegrationOptions options;
  options.end = 6;
  options.interval = 0.1;
  const Motion motion = integrate(
      knee.network, state_at_rest(model, cover_pairs(model), knee, equilibrium(1.5)), options);
  ASSERT_TRUE(motion.completed) << motion.reason;
  const RigidTransform& X = motion.frames.back().state.bodies[0].X;
  const EquilibriumState rest = equilibrium(1);
  EXPECT_GT((motion.frames.front().state.bodies[0].X.p - rest.X.p).norm(), 1e-3);
  EXPECT_LT((X.p - rest.X.p).norm(), 1e-6);
  EXPECT_LT((X.R - rest.X.R).norm(), 1e-6 / model.length);
  EXPECT_LT(motion.largest_imbalance, 1e-6 * motion.energy_scale);
}

// A point of contact that comes and goes between two frames is met all the same.
TEST(KneeMotion, DoesNotDependOnHowManyFramesAreStored) {
  Scene scene = read_scene(CONDYLE_SOURCE_DIR "/data/phantom/blow.toml");
  scene.simulation->time = 0.3;
  const std::vector<FittedSurface> surfaces = fit_surfaces(scene);
  const auto with_rate = [&](double rate) {
    scene.simulation->rate = rate;
    return simulate(scene, surfaces);
  };
  const Simulation often = with_rate(500);
  ASSERT_TRUE(often.motion.completed) << often.motion.reason;
  for (const double rate : {2., 33.}) {
    const Simulation seldom = with_rate(rate);
    ASSERT_EQ(seldom.motion.events.size(), often.motion.events.size()) << rate;
    for (std::size_t i = 0; i < often.motion.events.size(); ++i)
      EXPECT_NEAR(seldom.motion.events[i].t, often.motion.events[i].t, 1e-6);
    const RigidTransform &a = seldom.poses.back().X_BA, &b = often.poses.back().X_BA;
    EXPECT_LT((a.p - b.p).norm(), 1e-5);
    EXPECT_LT((a.R - b.R).norm(), 1e-6);
  }
}

// The phantom, held at 20 degrees: compressed half as much again at first, it comes to rest where
// the engine puts it.
TEST(KneeMotion, ThePhantomComesToRestAtTheEnginesPose) {
  Scene scene = read_scene(CONDYLE_SOURCE_DIR "/data/phantom/pendulum.toml");
  ConditionDescription flexion;
  flexion.name = "flexion";
  flexion.kind = ConditionKind::kFlexion;
  scene.conditions.push_back(flexion);
  SimulationDescription& simulation = *scene.simulation;
  simulation.hold = {0};
  simulation.viscous_time = 0.1;
  simulation.rate = 1;
  simulation.time = 1;
  const std::vector<FittedSurface> surfaces = fit_surfaces(scene);
  const RigidTransform rest = simulate(scene, surfaces).poses.front().X_BA;

  DriveDescription drive;
  drive.load = 0;
  drive.shape = DriveDescription::Shape::kTable;
  drive.times = {0, 0.1};
  drive.factors = {1.5, 1};
  simulation.drives = {drive};
  simulation.time = 12;
  const Simulation motion = simulate(scene, surfaces);
  ASSERT_TRUE(motion.motion.completed) << motion.motion.reason;
  EXPECT_GT((motion.poses.front().X_BA.p - rest.p).norm(), 1e-3);
  EXPECT_LT((motion.poses.back().X_BA.p - rest.p).norm(), 1e-6);
  EXPECT_LT((motion.poses.back().X_BA.R - rest.R).norm(), 1e-6 / 30);
}

// A pair that is held closed at one point touches at a second one, too, and does so in a motion; then the
// load moves beyond it, and what pushes alone there lifts off.
TEST(KneeMotion, WhatIsHeldAtOnePointMayTouchAtMore) {
  const Model model = test::on_two_feet(ContactMode::kClosed);
  EquilibriumSolver solver(model);
  ASSERT_TRUE(solver.solve().converged());
  KneeNetwork knee = make_knee_network(model, test::leg());
  NetworkState start = state_at_rest(model, cover_pairs(model), knee, solver.state());
  IntegrationOptions options;
  options.end = 0.1;
  options.interval = 0.02;
  const Motion rests = integrate(knee.network, start, options);
  ASSERT_TRUE(rests.completed) << rests.reason;
  for (const MotionFrame& frame : rests.frames) {
    double force = 0;
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_TRUE(frame.state.contacts[i].closed);
      force += frame.contact_force[i];
      EXPECT_NEAR(frame.contact_force[i] * (frame.contact_force[i] - 10), -3.8 * 6.2, 1e-6);
    }
    EXPECT_NEAR(force, 10, 1e-9);
  }
  const bool first_is_left =
      start.contacts[0].places.on_B.numbers.x() < start.contacts[1].places.on_B.numbers.x();
  knee.network.forces[0].load.at.x() = first_is_left ? -6 : 6;
  const Motion tilts = integrate(knee.network, start, options);
  ASSERT_FALSE(tilts.frames.empty());
  EXPECT_TRUE(tilts.frames.back().state.contacts[0].closed);
  EXPECT_FALSE(tilts.frames.back().state.contacts[1].closed);
}

// Undamped and with the flexion free, the energy stays what it was.
TEST(KneeMotion, KeepsItsEnergyWhileItSwings) {
  const Model model = test::quadric_knee();
  KneeNetwork knee = make_knee_network(model, test::leg());
  knee.network.conditions.clear();
  knee.network.gravity = {0, -9810, 0};
  IntegrationOptions options;
  options.end = 0.2;
  options.interval = 0.01;
  options.tolerance = 1e-11;
  const Motion motion = integrate(
      knee.network, state_at_rest(model, cover_pairs(model), knee, equilibrium(1)), options);
  ASSERT_TRUE(motion.completed) << motion.reason;
  EXPECT_GT(motion.energy_scale, 100);
  EXPECT_LT(motion.largest_imbalance, 1e-7 * motion.energy_scale);
  NetworkEquations equations(knee.network);
  for (const MotionFrame& frame : motion.frames) {
    NetworkState state = frame.state;
    ASSERT_TRUE(equations.assemble(state) && equations.solve());
    EdgeVariables x, y;
    equations.edge_variables(x, y);
    const TellegenSum power = tellegen_sum(x, y);
    double weights = 4e-3 * 9810 * state.bodies[0].v.norm();
    EXPECT_LE(std::abs(power.sum), 1e-12 * (power.scale + weights)) << frame.state.t;
  }
}

// Ten seconds of an undamped swing, in the mission's figure: 1e-8 of the total energy.
TEST(KneeMotion, KeepsItsEnergyForTenSeconds) {
  const Model model = test::quadric_knee();
  KneeNetwork knee = make_knee_network(model, test::leg());
  knee.network.gravity = {0, -9810, 0};
  IntegrationOptions options;
  options.end = 10;
  options.interval = 0.1;
  options.tolerance = 1e-12;
  const Motion motion = integrate(
      knee.network, state_at_rest(model, cover_pairs(model), knee, equilibrium(1)), options);
  ASSERT_TRUE(motion.completed) << motion.reason;
  EXPECT_GT(motion.energy_scale, 10);
  EXPECT_LT(motion.largest_imbalance, 1e-8 * motion.energy_scale);
}

// An integrator that fails says when and why, keeps what it has stored, and a detection that lets
// frames be tried again in halves does not multiply what is lost already.
TEST(KneeMotion, TooManyStepsEndItAtOnce) {
  const Model model = test::quadric_knee();
  KneeNetwork knee = make_knee_network(model, test::leg());
  knee.network.conditions.clear();
  knee.network.gravity = {0, -9810, 0};
  IntegrationOptions options;
  options.end = 0.1;
  options.interval = 0.01;
  options.tolerance = 1e-12;
  options.most_steps = 60;
  std::vector<double> detected;
  const Motion motion =
      integrate(knee.network, state_at_rest(model, cover_pairs(model), knee, equilibrium(1)),
                options, [&](NetworkState& state) {
                  detected.push_back(state.t);
                  return DetectedContacts{};
                });
  EXPECT_FALSE(motion.completed);
  EXPECT_NE(motion.reason.find("too many steps for one frame"), std::string::npos) << motion.reason;
  EXPECT_EQ(motion.reason.find("at 0"), 0U) << motion.reason;
  EXPECT_GE(motion.frames.size(), 1U);
  // No time twice.
  EXPECT_GE(detected.size(), motion.frames.size());
  EXPECT_EQ(std::adjacent_find(detected.begin(), detected.end(), std::greater_equal<>()),
            detected.end());
  EXPECT_LT(motion.steps, 70 * static_cast<long>(motion.frames.size() + 1));
}

// Frames that are always overlapped are tried in halves, but not without end.
TEST(KneeMotion, AnOverlapThatStaysEndsTheMotionInBoundedTime) {
  const Model model = test::quadric_knee();
  const KneeNetwork knee = make_knee_network(model, test::leg());
  IntegrationOptions options;
  options.end = options.interval = 0.01;
  long asked = 0;
  const Motion motion =
      integrate(knee.network, state_at_rest(model, cover_pairs(model), knee, equilibrium(1)),
                options, [&](NetworkState& state) {
                  ++asked;
                  DetectedContacts detected;
                  if (state.t > 0.002) detected.unseen = -1;
                  return detected;
                });
  EXPECT_FALSE(motion.completed);
  EXPECT_NE(motion.reason.find("overlap where no contact could be followed"), std::string::npos);
  EXPECT_LT(asked, 250);
  EXPECT_EQ(motion.frames.size(), 1U);
}

// A pulse of 3 ms in a second of rest is not stepped over: m v = F d.
TEST(KneeMotion, AShortPulseIsSeen) {
  Network network;
  network.bodies = {{"leg", test::leg(), test::leg().center, false}};
  Load push;
  push.vector = {100, 0, 0};
  push.at = test::leg().center;
  DriveDescription pulse;
  pulse.load = 0;
  pulse.start = 0.5;
  pulse.duration = 0.003;
  const std::vector<DriveDescription> drives = {pulse};
  network.forces = {{"push", 0, push, [&](double t) { return load_scale_at(drives, 0, t); }}};
  NetworkState state;
  state.bodies.resize(1);
  IntegrationOptions options;
  options.end = options.interval = 1;
  options.breaks = drive_breaks(drives);
  const Motion motion = integrate(network, state, options);
  ASSERT_TRUE(motion.completed) << motion.reason;
  const double v = 100 * 0.003 / 4e-3;
  const BodyState& body = motion.frames.back().state.bodies[0];
  EXPECT_NEAR(body.v.x(), v, 1e-6 * v);
  EXPECT_NEAR(body.X.p.x(), v * (0.5 - 0.0015), 1e-6 * v);
  EXPECT_NEAR(motion.frames.back().driver_work, 4e-3 * v * v / 2, 1e-5);
}

TEST(KneeMotion, DrivesHaveTheirCourse) {
  DriveDescription sine;
  sine.load = 1;
  sine.shape = DriveDescription::Shape::kDecayingSine;
  sine.start = 0.1;
  sine.frequency = 5;
  sine.decay = 3;
  DriveDescription table;
  table.load = 2;
  table.shape = DriveDescription::Shape::kTable;
  table.times = {0, 1, 3};
  table.factors = {2, 4, 0};
  const std::vector<DriveDescription> drives = {sine, table};
  EXPECT_EQ(load_scale_at(drives, 0, 5), 1);  // has none
  EXPECT_EQ(load_scale_at(drives, 1, 0.05), 0);
  EXPECT_NEAR(load_scale_at(drives, 1, 0.15), std::exp(-0.15), 1e-14);
  EXPECT_EQ(load_scale_at(drives, 2, -1), 2);
  EXPECT_EQ(load_scale_at(drives, 2, 2), 2);
  EXPECT_EQ(load_scale_at(drives, 2, 9), 0);
}

}  // namespace
}  // namespace condyle
