/// Scenes with elastic layers as build_model takes them: the phantom on layers told in other frames,
/// beside a rigid contact, with stiff layers, and a ball whose depth is known.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "condyle/contact/layer_contact.h"
#include "condyle/equilibrium/build_model.h"
#include "condyle/equilibrium/sweep.h"
#include "condyle/math/degree.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/specimen/fit_surfaces.h"
#include "condyle/surface/exact_surfaces.h"
#include "support/allocation_count.h"
#include "support/hold.h"
#include "support/moved_scene.h"

namespace condyle {
namespace {

Scene layered_phantom(double modulus = 10) {
  Scene scene = read_scene(CONDYLE_SOURCE_DIR "/data/phantom/knee.toml");
  for (SurfaceDescription& surface : scene.surfaces)
    surface.elastic = ElasticSurface{modulus, 0.45, 3};
  for (ContactDescription& contact : scene.contacts) contact.layer = LayerOptions{};
  scene.sweep->values = {0, 30 * kDegree, 60 * kDegree, 90 * kDegree};
  return scene;
}

const std::vector<FittedSurface>& fitted() {
  static const std::vector<FittedSurface> surfaces = fit_surfaces(layered_phantom());
  return surfaces;
}

void expect_all_converged(const SweepResult& result) {
  for (const PoseResult& pose : result.poses)
    EXPECT_TRUE(pose.converged()) << pose.value / kDegree << ": " << pose.reason;
}

TEST(LayerScene, IsTheSameKneeInOtherFrames) {
  const Scene scene = layered_phantom();
  const SweepResult expected = sweep(scene, fitted());
  expect_all_converged(expected);
  const test::Move move{{exp_rotation({0.4, -0.3, 1.1}), {300, -200, 80}},
                        {exp_rotation({-0.7, 0.2, 0.5}), {-90, 500, 40}}};
  const test::MovedScene moved(scene, move);
  const SweepResult actual = sweep(moved.scene(), moved.surfaces(fitted()));
  for (std::size_t i = 0; i < expected.poses.size(); ++i) {
    const PoseResult &e = expected.poses[i], &a = actual.poses[i];
    ASSERT_TRUE(a.converged()) << a.reason;
    EXPECT_LT((moved.back(a).X_BA.p - e.X_BA.p).norm(), 1e-7);
    for (std::size_t c = 0; c < e.contacts.size(); ++c) {
      ASSERT_TRUE(e.contacts[c].layer && a.contacts[c].layer);
      const LayerResult &le = *e.contacts[c].layer, &la = *a.contacts[c].layer;
      EXPECT_NEAR(a.contacts[c].force, e.contacts[c].force, 1e-6);
      EXPECT_NEAR(la.area, le.area, 1e-6);
      EXPECT_NEAR(la.energy, le.energy, 1e-6);
      EXPECT_NEAR(la.peak_pressure, le.peak_pressure, 1e-7);
      EXPECT_LT((move.B.R.transpose() * la.force - le.force).norm(), 1e-6);
      ASSERT_EQ(a.contacts[c].pressures.size(), e.contacts[c].pressures.size());
      // The moment about the moving body's origin, brought to the centre of pressure.
      const auto about_center = [](const PoseResult& pose, std::size_t k) {
        const ContactResult& contact = pose.contacts[k];
        return Eigen::Vector3d(
            contact.layer->moment -
            (contact.resultant_ground - pose.X_BA.p).cross(contact.layer->force));
      };
      EXPECT_LT((move.B.R.transpose() * about_center(a, c) - about_center(e, c)).norm(), 1e-4);
      const PressurePoint &pe = e.contacts[c].pressures.back(),
                          &pa = a.contacts[c].pressures.back();
      const RigidTransform& X = pe.on_A ? move.A : move.B;
      EXPECT_LT((pa.point - X * pe.point).norm(), 1e-9);
    }
  }
}

TEST(LayerScene, StandsBesideARigidContact) {
  Scene scene = layered_phantom();
  scene.contacts[1].layer.reset();
  const SweepResult mixed = sweep(scene, fitted());
  expect_all_converged(mixed);
  for (const PoseResult& pose : mixed.poses) {
    EXPECT_TRUE(pose.contacts[0].layer);
    EXPECT_FALSE(pose.contacts[1].layer);
    EXPECT_LT(std::abs(pose.contacts[1].points.at(0).gap), 1e-9);
  }
}

// At a fixed load depths go with E^-1/2: from 1,000 to 100,000 N/mm² to a tenth.
TEST(LayerScene, StiffLayersAreFoundFromAStartThatOverlaps) {
  std::vector<double> depths;
  for (const double modulus : {1e3, 1e5}) {
    Scene scene = layered_phantom(modulus);
    scene.sweep->values = {0};
    const int moving = scene.moving_body();
    BodyDescription& body = scene.bodies[static_cast<std::size_t>(moving)];
    body.start_translation += 1.5 * scene.joint->femur.proximal;
    const SweepResult result = sweep(scene, fitted());
    ASSERT_TRUE(result.poses[0].converged()) << modulus << ": " << result.poses[0].reason;
    depths.push_back(result.poses[0].contacts[0].layer.value().deepest);
  }
  EXPECT_NEAR(depths[1] / depths[0], 0.1, 0.02);
}

// Contacts of half a millimetre, which lie between the points of the coarsest lattice.
TEST(LayerScene, StiffLayersAreSwept) {
  Scene scene = layered_phantom(1e5);
  scene.sweep->values = {0, 5 * kDegree, 10 * kDegree, 100 * kDegree};
  for (const PoseResult& pose : sweep(scene, fitted()).poses) {
    ASSERT_TRUE(pose.converged()) << pose.value / kDegree << ": " << pose.reason;
    for (const ContactResult& contact : pose.contacts)
      EXPECT_GT(contact.layer.value().force.norm(), 20) << pose.value / kDegree;
  }
}

/// A solid that 40 N press on the layer of a floor without bounds, free to go up and down.
Model on_a_layer(std::shared_ptr<const Surface> solid, double height) {
  Model model;
  ContactPair pair;
  pair.name = "floor";
  pair.on_B = make_plane({0, 0, 0}, {0, 0, 1});
  pair.on_A = std::move(solid);
  pair.elastic_B = ElasticSurface{10, 0.45, 3};
  pair.mode = ContactMode::kOpen;
  pair.law = layer_contact();
  model.pairs = {pair};
  Load weight;
  weight.vector = {0, 0, -40};
  model.loads = {weight};
  model.load_names = {"weight"};
  for (const int axis : {0, 1}) test::hold(model, ConditionKind::kTranslation, axis);
  for (const int axis : {0, 1, 2}) test::hold(model, ConditionKind::kRotation, axis);
  model.start.p = {0, 0, height};
  model.length = 20;
  return model;
}

// A dish on its edge: its back and its hollow look sideways and press little, so that a pose of equilibrium lies far
// below the floor.
TEST(LayerScene, NoLayerBearsADishThatStandsOnItsEdge) {
  const std::shared_ptr<const Surface> dish = make_polynomial(
      {0, 0, -20}, exp_rotation({M_PI / 2, 0, 0}), {{2, 0, 0.025}, {0, 2, 0.025}}, true, 20);
  const PoseResult pose = EquilibriumSolver(on_a_layer(dish, 15)).solve();
  EXPECT_EQ(pose.status, PoseStatus::kOverlap) << pose.reason;
  EXPECT_NE(pose.reason.find("its surfaces overlap by"), std::string::npos) << pose.reason;
}

// The finest lattice of a bowl of 10 m has points 20 mm from each other. A ball of 20 mm has them where they are needed.
TEST(LayerScene, AForceThatItsLatticeDoesNotKnowIsNotToldAsOne) {
  const std::shared_ptr<const Surface> bowl = make_polynomial(
      {0, 0, 0}, exp_rotation({M_PI, 0, 0}), {{2, 0, -5e-5}, {0, 2, -5e-5}}, true, 5000);
  const PoseResult coarse = EquilibriumSolver(on_a_layer(bowl, 0)).solve();
  EXPECT_EQ(coarse.status, PoseStatus::kIterationLimit);
  EXPECT_NE(coarse.reason.find("the force of its layers is uncertain by"), std::string::npos)
      << coarse.reason;
  const PoseResult fine =
      EquilibriumSolver(on_a_layer(make_sphere({0, 0, 0}, 20, true), 20)).solve();
  ASSERT_TRUE(fine.converged()) << fine.reason;
  EXPECT_LE(fine.contacts[0].layer->error, LayerOptions().tolerance);
}

TEST(LayerScene, AllocatesNothingOnAWayThatItKnows) {
  if (!test::allocations_are_counted()) GTEST_SKIP() << "allocations are not counted here";
  const Scene scene = layered_phantom();
  EquilibriumSolver solver(build_model(scene, fitted()));
  const Drive still = drive_of(solver.model());
  PoseResult pose;
  std::vector<Drive> drives;
  for (const double flexion : {20.0, 21.0, 22.0, 21.0, 20.0})
    drives.push_back(condition_value(0).with(still, flexion * kDegree));
  const auto there_and_back = [&] {
    for (const Drive& drive : drives) {
      solver.solve(drive, pose, Patience::kAll);
      EXPECT_TRUE(pose.converged()) << pose.reason;
    }
  };
  there_and_back();
  there_and_back();
  const test::AllocationCount count;
  there_and_back();
  EXPECT_EQ(count.since_start(), 0);
}

}  // namespace
}  // namespace condyle
