/// Where a file has its origin, and how its axes are turned, has no say in any result.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "condyle/equilibrium/events.h"
#include "condyle/equilibrium/sweep.h"
#include "condyle/math/degree.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/specimen/fit_surfaces.h"
#include "condyle/specimen/fit_wraps.h"
#include "equilibrium/without_events.h"
#include "support/knee_scenes.h"
#include "support/moved_scene.h"
#include "support/scratch_folder.h"

namespace condyle {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;
using test::Move;
using test::MovedScene;
using test::to;

constexpr double kLength = 1e-8, kAngle = 1e-8 * kDegree;  // [mm], [rad]
constexpr double kForce = 1e-8;                            // of 1 N or of the force

const Vector3d kOdd = Vector3d(0.48, -0.6, 0.64), kOther = Vector3d(-0.36, 0.8, 0.48);

struct NamedMove {
  const char* name;
  Move move;
};

const std::vector<NamedMove>& moves() {
  const RigidTransform turned{exp_rotation({0.7, -1.9, 0.4}), {0, 0, 0}};
  const RigidTransform far_turned{exp_rotation({-2.1, 0.3, 1.1}), 1000 * kOther};
  static const std::vector<NamedMove> all = {
      {"fixed by 0.1 m", {to(100 * kOdd), {}}},
      {"fixed by 3 m", {to(3000 * kOdd), {}}},
      {"moving by 1 m", {{}, to(1000 * kOther)}},
      {"moving by 3 m", {{}, to(3000 * kOdd)}},
      {"both by 3 m", {to(3000 * kOther), to(-3000 * kOdd)}},
      {"both turned", {turned, {exp_rotation({1.3, 0.2, 2.2}), {0, 0, 0}}}},
      {"both far and turned", {far_turned, {exp_rotation({0.2, -1.1, -0.6}), 3000 * kOdd}}}};
  return all;
}

/// Points of a contact have no order.
const ContactPointResult& nearest_to(const ContactPointResult& p, const ContactResult& contact) {
  return *std::min_element(contact.points.begin(), contact.points.end(),
                           [&p](const ContactPointResult& q, const ContactPointResult& r) {
                             return (q.point_ground - p.point_ground).squaredNorm() <
                                    (r.point_ground - p.point_ground).squaredNorm();
                           });
}

void expect_same_points(const ContactResult& a, const ContactResult& b) {
  ASSERT_EQ(a.points.size(), b.points.size());
  for (const ContactPointResult& p : a.points) {
    const ContactPointResult& q = nearest_to(p, b);
    EXPECT_LT((p.point_ground - q.point_ground).norm(), kLength);
    EXPECT_LT((p.point_moving - q.point_moving).norm(), kLength);
    EXPECT_LT((p.normal_ground - q.normal_ground).norm(), kAngle);
    EXPECT_NEAR(p.force, q.force, kForce * std::max(1.0, std::abs(p.force)));
    EXPECT_NEAR(p.gap, q.gap, kLength);
  }
}

void expect_same_joint(const JointCoordinates& a, const JointCoordinates& b) {
  EXPECT_NEAR(a.flexion, b.flexion, kAngle);
  EXPECT_NEAR(a.adduction, b.adduction, kAngle);
  EXPECT_NEAR(a.internal_rotation, b.internal_rotation, kAngle);
  EXPECT_NEAR(a.lateral_shift, b.lateral_shift, kLength);
  EXPECT_NEAR(a.anterior_drawer, b.anterior_drawer, kLength);
  EXPECT_NEAR(a.distraction, b.distraction, kLength);
}

/// Where a motion is free, nothing but its start says how far it went.
bool is_neutral(const PoseResult& pose) { return pose.remark.rfind("neutral", 0) == 0; }

void expect_same(const PoseResult& a, const PoseResult& b) {
  ASSERT_EQ(a.status, b.status) << a.reason << " / " << b.reason;
  if (!a.converged()) return;
  EXPECT_EQ(a.stability, b.stability);
  EXPECT_EQ(is_neutral(a), is_neutral(b));
  if (is_neutral(a)) return;
  expect_same_joint(a.joint, b.joint);
  EXPECT_LT((a.X_BA.R - b.X_BA.R).norm(), kAngle);
  EXPECT_LT((a.X_BA.p - b.X_BA.p).norm(), kLength);
  for (std::size_t c = 0; c < a.contacts.size(); ++c) {
    EXPECT_EQ(a.contacts[c].closed, b.contacts[c].closed);
    expect_same_points(a.contacts[c], b.contacts[c]);
  }
  for (std::size_t i = 0; i < a.ligaments.size(); ++i) {
    EXPECT_NEAR(a.ligaments[i].length, b.ligaments[i].length, kLength);
    EXPECT_NEAR(a.ligaments[i].force, b.ligaments[i].force,
                kForce * std::max(1.0, a.ligaments[i].force));
  }
  for (std::size_t i = 0; i < a.conditions.size(); ++i)
    EXPECT_NEAR(a.conditions[i].multiplier, b.conditions[i].multiplier,
                kForce * std::max(1.0, std::abs(a.conditions[i].multiplier)));
}

void expect_same(const SweepResult& expected, const SweepResult& actual, const MovedScene& moved) {
  ASSERT_EQ(expected.poses.size(), actual.poses.size());
  for (std::size_t k = 0; k < expected.poses.size(); ++k) {
    SCOPED_TRACE(testing::Message() << "pose at " << expected.poses[k].value);
    expect_same(expected.poses[k], moved.back(actual.poses[k]));
  }
}

/// Surfaces and wraps are moved as they were fitted once: what the engine makes of them.
void sweep_everywhere(const fs::path& file) {
  SCOPED_TRACE(file.string());
  Scene scene = read_scene(file);
  if (!scene.sweep) return;
  const std::vector<FittedSurface> surfaces = fit_surfaces(scene);
  fit_wraps(scene, surfaces);
  const SweepResult expected = sweep(scene, surfaces, without_events());
  for (const auto& [name, move] : moves()) {
    if (!MovedScene::can(scene, move)) continue;
    SCOPED_TRACE(name);
    const MovedScene moved(scene, move);
    expect_same(expected, sweep(moved.scene(), moved.surfaces(surfaces), without_events()), moved);
  }
}

TEST(Places, OfFilesHaveNoSayInSweepsOfTheScenesThatAreShipped) {
  for (const fs::path& file : test::shipped_scenes()) sweep_everywhere(file);
}

TEST(Places, OfFilesHaveNoSayInSweepsOfRealKnees) {
  const std::vector<fs::path> scenes = test::specimen_scenes();
  if (scenes.empty()) GTEST_SKIP() << "no specimens here";
  for (const fs::path& file : scenes) sweep_everywhere(file);
}

/// Knots, mask and control points: a patch that is moved back is the patch. A smoothing length and
/// the knots are chosen by the shape alone, so nothing but round-off may differ.
void expect_same_patch(const FittedSurface& wanted, const FittedSurface& actual) {
  const PatchData &a = dynamic_cast<const Patch&>(*wanted.surface).data(),
                  &b = dynamic_cast<const Patch&>(*actual.surface).data();
  EXPECT_NEAR(wanted.report->smoothing_length, actual.report->smoothing_length, kLength);
  ASSERT_EQ(a.knots_u, b.knots_u);
  ASSERT_EQ(a.knots_v, b.knots_v);
  EXPECT_EQ(a.orientation, b.orientation);
  const Patch p(a), q(b);
  double off = 0, edge = 0;
  for (const Place& place : p.samples(1)) {
    off = std::max(off, (p.evaluate(place).c - q.evaluate(place).c).norm());
    edge = std::max(edge, std::abs(p.edge_distance(place) - q.edge_distance(place)));
  }
  EXPECT_LT(off, kLength);
  EXPECT_LT(edge, kLength);
}

void expect_same_patches(const Scene& scene,
                         const std::vector<FittedSurface>& wanted,
                         const std::vector<FittedSurface>& actual) {
  for (std::size_t i = 0; i < actual.size(); ++i) {
    if (scene.surfaces[i].kind != SurfaceKind::kPatch) continue;
    SCOPED_TRACE(scene.surfaces[i].name);
    expect_same_patch(wanted[i], actual[i]);
  }
}

void fit_everywhere(const fs::path& file) {
  SCOPED_TRACE(file.string());
  const Scene scene = read_scene(file);
  const std::vector<FittedSurface> expected = fit_surfaces(scene);
  for (const auto& [name, move] : {moves()[4], moves()[6]}) {
    if (!MovedScene::can(scene, move)) continue;
    SCOPED_TRACE(name);
    const MovedScene moved(scene, move);
    expect_same_patches(scene, moved.surfaces(expected),
                        fit_surfaces(moved.scene(), {}, moved.mesh_reader()));
  }
}

TEST(Places, OfFilesHaveNoSayInTheFitsOfTheScenesThatAreShipped) {
  for (const fs::path& file : test::shipped_scenes()) fit_everywhere(file);
}

TEST(Places, OfFilesHaveNoSayInTheFitsOfRealKnees) {
  const std::vector<fs::path> scenes = test::specimen_scenes();
  if (scenes.empty()) GTEST_SKIP() << "no specimens here";
  for (const fs::path& file : scenes) fit_everywhere(file);
}

// From files with all digits to the last pose.
TEST(Places, OfFilesHaveNoSayFromTheFileToTheAnswer) {
  const Scene scene = read_scene(CONDYLE_SOURCE_DIR "/data/phantom/knee.toml");
  MovedScene moved(scene, moves()[6].move);
  moved.write_meshes(test::fresh_folder("moved knee"));
  const std::vector<FittedSurface> here = fit_surfaces(scene), there = fit_surfaces(moved.scene());
  expect_same_patches(scene, moved.surfaces(here), there);
  expect_same(sweep(scene, here, without_events()), sweep(moved.scene(), there, without_events()),
              moved);
}

}  // namespace
}  // namespace condyle
