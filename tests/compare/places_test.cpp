/// The reference model, tests of laxity and motions do not ask either where a file has its origin.

#include <gtest/gtest.h>

#include <cmath>

#include "condyle/compare/compare.h"
#include "condyle/compare/laxity.h"
#include "condyle/equilibrium/sweep.h"
#include "condyle/network/simulate.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/specimen/fit_surfaces.h"
#include "support/moved_scene.h"

namespace condyle {
namespace {

using Eigen::Vector3d;
using test::Move;
using test::MovedScene;
using test::to;

const std::filesystem::path kShipped = CONDYLE_SOURCE_DIR "/data";
constexpr double kLength = 1e-8, kAngle = 1e-8 * M_PI / 180;  // [mm], [rad]
constexpr double kForce = 1e-8;                               // of 1 N or of the force
constexpr double kOfMotion =
    1e4;  // an integrator leaves its tolerance, in steps that react to the last digit

const Move kFar = {to({1440, -1800, 1920}), to({-1080, 2400, 1440})};
const Move kFarther = {to({-90, 2900, 310}), to({-90, 2900, 310})};

void expect_same(const SweepResult& a,
                 const SweepResult& b,
                 const MovedScene& moved,
                 double times = 1) {
  ASSERT_EQ(a.poses.size(), b.poses.size());
  for (std::size_t k = 0; k < a.poses.size(); ++k) {
    SCOPED_TRACE(testing::Message() << "pose at " << a.poses[k].value);
    const PoseResult &p = a.poses[k], q = moved.back(b.poses[k]);
    ASSERT_EQ(p.status, q.status) << p.reason << " / " << q.reason;
    if (!p.converged()) continue;
    EXPECT_LT((p.X_BA.R - q.X_BA.R).norm(), times * kAngle);
    EXPECT_LT((p.X_BA.p - q.X_BA.p).norm(), times * kLength);
    for (std::size_t c = 0; c < p.contacts.size(); ++c) {
      EXPECT_NEAR(p.contacts[c].force, q.contacts[c].force,
                  times * kForce * std::max(1.0, std::abs(p.contacts[c].force)));
      if (!p.contacts[c].closed) continue;
      EXPECT_LT((p.contacts[c].resultant_ground - q.contacts[c].resultant_ground).norm(),
                times * kLength);
    }
    for (std::size_t i = 0; i < p.ligaments.size(); ++i)
      EXPECT_NEAR(p.ligaments[i].force, q.ligaments[i].force,
                  times * kForce * std::max(1.0, p.ligaments[i].force));
  }
}

TEST(ComparedPlaces, OfFilesHaveNoSayInAComparison) {
  Scene scene = read_scene(kShipped / "wismans-type/knee.toml");
  const std::vector<FittedSurface> surfaces = fit_surfaces(scene);
  SweepOptions plain;
  plain.events = plain.stability = false;
  const Comparison expected = compare(scene, surfaces, sweep(scene, surfaces, plain));
  // Not turned: the heights of the reference stand on the planes of the body's own axes.
  for (const Move& move : {kFar, kFarther}) {
    const MovedScene moved(scene, move);
    const std::vector<FittedSurface> there = moved.surfaces(surfaces);
    const Comparison actual = compare(moved.scene(), there, sweep(moved.scene(), there, plain));
    expect_same(expected.reference, actual.reference, moved);
    EXPECT_EQ(expected.converged, actual.converged);
    for (std::size_t q = 0; q < expected.quantities.size(); ++q)
      for (std::size_t v = 0; v < expected.quantities[q].values.size(); ++v)
        for (std::size_t k = 0; k < expected.quantities[q].values[v].size(); ++k) {
          const double a = expected.quantities[q].values[v][k],
                       b = actual.quantities[q].values[v][k];
          EXPECT_EQ(std::isnan(a), std::isnan(b));
          if (!std::isnan(a)) {
            EXPECT_NEAR(a, b, 1e-8 * std::max(1.0, std::abs(a)));
          }
        }
  }
}

TEST(ComparedPlaces, OfFilesHaveNoSayInATestOfLaxity) {
  Scene scene = read_scene(kShipped / "wismans-type/drawer.toml");
  scene.laxity->flexions = {0, M_PI / 3};
  const std::vector<FittedSurface> surfaces = fit_surfaces(scene);
  const LaxityResult expected = test_laxity(scene, surfaces);
  const MovedScene moved(scene, kFar);
  const LaxityResult actual = test_laxity(moved.scene(), moved.surfaces(surfaces));
  ASSERT_EQ(expected.curves.size(), actual.curves.size());
  for (std::size_t k = 0; k < expected.curves.size(); ++k) {
    expect_same(expected.curves[k].ours, actual.curves[k].ours, moved);
    ASSERT_TRUE(expected.curves[k].reference && actual.curves[k].reference);
    expect_same(*expected.curves[k].reference, *actual.curves[k].reference, moved);
  }
}

// Not turned: the integrator weighs components.
TEST(ComparedPlaces, OfFilesHaveNoSayInAMotion) {
  Scene scene = read_scene(kShipped / "phantom/pendulum.toml");
  scene.simulation->time = 0.1;
  const std::vector<FittedSurface> surfaces = fit_surfaces(scene);
  const MovedScene moved(scene, kFar);
  const Simulation expected = simulate(scene, surfaces);
  const Simulation actual = simulate(moved.scene(), moved.surfaces(surfaces));
  ASSERT_TRUE(expected.motion.completed) << expected.motion.reason;
  expect_same({expected.poses, {}}, {actual.poses, {}}, moved, kOfMotion);
}

}  // namespace
}  // namespace condyle
