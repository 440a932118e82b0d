/// A motion that goes on from the stretches of one that was stopped is the same to the last bit:
/// contacts, strands over surfaces, elastic layers.

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <functional>

#include "condyle/contact/contact_pair.h"
#include "condyle/contact/layer_contact.h"
#include "condyle/equilibrium/build_model.h"
#include "condyle/equilibrium/equilibrium_solver.h"
#include "condyle/equilibrium/model_covers.h"
#include "condyle/input_error.h"
#include "condyle/network/contact_detection.h"
#include "condyle/network/motion_lattices.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/surface/exact_surfaces.h"
#include "network/integration_options.h"
#include "support/leg.h"
#include "support/quadric_knee.h"
#include "support/wrapped_scenes.h"

namespace condyle {
namespace {

using Move = std::function<Motion(MotionKeeping)>;

/// The bits of all numbers of a frame.
std::vector<std::uint64_t> bits_of(const MotionFrame& frame) {
  std::vector<std::uint64_t> bits;
  const auto add = [&](double number) { bits.push_back(std::bit_cast<std::uint64_t>(number)); };
  const auto add_all = [&](const auto& matrix) {
    for (Eigen::Index i = 0; i < matrix.size(); ++i) add(matrix.data()[i]);
  };
  add(frame.state.t);
  for (const BodyState& body : frame.state.bodies) {
    add_all(body.X.R);
    add_all(body.X.p);
    add_all(body.v);
    add_all(body.omega);
  }
  for (const MovingContact& contact : frame.state.contacts) {
    add_all(contact.places.on_A.numbers);
    add_all(contact.places.on_B.numbers);
    bits.push_back(contact.closed ? 1 : 0);
    bits.push_back(contact.followed ? 1 : 0);
  }
  for (const std::vector<double>* numbers :
       {&frame.contact_force, &frame.contact_gap, &frame.paths, &frame.condition_multiplier})
    for (const double number : *numbers) add(number);
  for (const LineState& line : frame.lines)
    for (const double number : {line.length, line.rate, line.force, line.energy, line.dissipation})
      add(number);
  for (const double number : {frame.energy.stored(), frame.dissipated, frame.driver_work})
    add(number);
  return bits;
}

void expect_same_bits(const Motion& a, const Motion& b) {
  EXPECT_EQ(a.completed, b.completed);
  EXPECT_EQ(a.reason, b.reason);
  EXPECT_EQ(a.steps, b.steps);
  EXPECT_EQ(a.evaluations, b.evaluations);
  EXPECT_EQ(a.largest_imbalance, b.largest_imbalance);
  EXPECT_EQ(a.energy_scale, b.energy_scale);
  ASSERT_EQ(a.frames.size(), b.frames.size());
  for (std::size_t i = 0; i < a.frames.size(); ++i)
    ASSERT_EQ(bits_of(a.frames[i]), bits_of(b.frames[i])) << "frame " << i;
  ASSERT_EQ(a.events.size(), b.events.size());
  for (std::size_t i = 0; i < a.events.size(); ++i) {
    EXPECT_EQ(a.events[i].t, b.events[i].t);
    EXPECT_EQ(a.events[i].contact, b.events[i].contact);
    EXPECT_EQ(a.events[i].speed, b.events[i].speed);
  }
}

/// After its first stretch, half of them and all.
void expect_goes_on(const Move& move) {
  std::vector<MotionStretch> stretches;
  const Motion whole =
      move({{}, [&](const MotionStretch& stretch) { stretches.push_back(stretch); }, {}});
  ASSERT_GE(stretches.size(), 3U);
  for (const std::size_t known : {std::size_t{1}, stretches.size() / 2, stretches.size()}) {
    SCOPED_TRACE(known);
    std::size_t computed = 0;
    const Motion resumed =
        move({{stretches.begin(), stretches.begin() + static_cast<std::ptrdiff_t>(known)},
              [&](const MotionStretch&) { ++computed; },
              {}});
    EXPECT_EQ(computed, stretches.size() - known);
    expect_same_bits(whole, resumed);
  }
}

/// Let go with an upward pull that ends: contacts open and close.
Motion swing(MotionKeeping keeping) {
  const Model model = test::quadric_knee();
  EquilibriumSolver solver(model);
  EXPECT_TRUE(solver.solve().converged());
  const ContactCovers covers = cover_pairs(model);
  KneeNetwork knee = make_knee_network(model, test::leg());
  knee.network.conditions.clear();
  knee.network.gravity = {0, -9810, 0};
  KneeContactDetection detect(model, covers, knee);
  keeping.forget = [&] { detect.forget(); };
  IntegrationOptions how = options(0.3, 0.005, 1e-9);
  how.stretch = 200;
  return integrate(knee.network, state_at_rest(model, covers, knee, solver.state()), how,
                   std::ref(detect), keeping);
}

TEST(ResumedMotion, OfAKneeIsTheSameToTheLastBit) { expect_goes_on(swing); }

TEST(ResumedMotion, OfStrandsOverSurfacesIsTheSameToTheLastBit) {
  const Scene scene = parse_scene(test::kHangingBody, "knee.toml");
  const Model model = build_model(scene, {});
  expect_goes_on([&](const MotionKeeping& keeping) {
    MassProperties mass;
    mass.mass = 2e-4;
    mass.center = {0, -65, 0};
    mass.inertia = Eigen::Vector3d(0.1, 0.08, 0.12).asDiagonal();
    const KneeNetwork knee = make_knee_network(model, mass);
    NetworkState state;
    state.bodies = {{model.start, {150, 40, -60}, {0, 0, 4}}};
    IntegrationOptions how = options(0.12, 0.005, 1e-11);
    how.stretch = 150;
    return integrate(knee.network, state, how, {}, keeping);
  });
}

/// A ball that bounces on two layers, seen by a lattice that its start asks for or a finer one.
Network ball_on_layers() {
  MassProperties mass;
  mass.mass = 1e-3;
  mass.inertia = 0.4 * 1e-3 * 900 * Eigen::Matrix3d::Identity();
  ContactPair pair;
  pair.name = "pad";
  pair.on_B = make_plane({0, 0, 0}, {0, 0, 1});
  pair.on_A = make_sphere({0, 0, 0}, 30, true);
  pair.elastic_B = pair.elastic_A = ElasticSurface{10, 0.45, 3};
  pair.mode = ContactMode::kOpen;
  LayerOptions layer;
  layer.tolerance = 1e-4;
  Network network;
  network.bodies = {{"ball", mass, {0, 0, 0}, false}};
  network.potentials = {{"pad", 0, layer_contact(layer)(pair)}};
  return network;
}

NetworkState above_layers(double height) {
  NetworkState state;
  state.bodies = {{{Eigen::Matrix3d::Identity(), {0, 0, 30 + height}}, {0, 0, -300}, {0, 3, 0}}};
  return state;
}

TEST(ResumedMotion, OnLayersIsTheSameToTheLastBit) {
  expect_goes_on([](const MotionKeeping& keeping) {
    Network network = ball_on_layers();
    network.gravity = {0, 0, -9810};
    const NetworkState state = above_layers(0);
    choose_lattices(state.bodies[0].X, network);
    refine_lattice({0, {Eigen::Matrix3d::Identity(), {0, 0, 29.8}}}, network);
    forget_places(network);
    IntegrationOptions how = options(0.06, 0.001, 1e-9);
    how.stretch = 60;
    return integrate(network, state, how, {}, keeping);
  });
}

/// Lattices that a motion asked for are those of whoever refines to the same poses.
TEST(ResumedMotion, ComesToTheSameLattices) {
  const NetworkState state = above_layers(0);
  const IntegrationOptions how = options(0.005, 0.0005, 1e-9);
  Network network = ball_on_layers();
  choose_lattices(state.bodies[0].X, network);
  std::vector<LatticeRefinement> refinements;
  Motion motion;
  for (;;) {
    forget_places(network);
    motion = integrate(network, state, how);
    const std::vector<LatticeRefinement> more = refine_lattices(motion, network);
    if (more.empty()) break;
    refinements.insert(refinements.end(), more.begin(), more.end());
  }
  ASSERT_FALSE(refinements.empty());
  Network again = ball_on_layers();
  choose_lattices(state.bodies[0].X, again);
  for (const LatticeRefinement& refinement : refinements) refine_lattice(refinement, again);
  forget_places(again);
  expect_same_bits(motion, integrate(again, state, how));
  EXPECT_THROW(refine_lattice({1, {}}, again), InputError);
}

TEST(ResumedMotion, RefusesFramesOfAnother) {
  std::vector<MotionStretch> stretches;
  (void)swing({{}, [&](const MotionStretch& stretch) { stretches.push_back(stretch); }, {}});
  ASSERT_FALSE(stretches.empty());
  const auto refused = [&](const std::function<void(MotionStretch&)>& change) {
    std::vector<MotionStretch> other = {stretches.front()};
    change(other.front());
    EXPECT_THROW((void)swing({other, {}, {}}), InputError);
  };
  refused([](MotionStretch& s) { s.frames.back().state.contacts.pop_back(); });
  refused([](MotionStretch& s) { s.frames.back().lines.clear(); });
  refused([](MotionStretch& s) { s.frames.back().state.bodies[0].v.x() = NAN; });
  refused([](MotionStretch& s) {
    s.frames.back().state.contacts[0].places.on_B.numbers.setConstant(NAN);
  });
  refused([](MotionStretch& s) { s.frames.insert(s.frames.end(), 1000, s.frames.back()); });
  refused([](MotionStretch& s) { s.events.push_back({0, 99, true, 0}); });
}

}  // namespace
}  // namespace condyle
