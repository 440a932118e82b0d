/// Ways to equilibria on elastic layers: displaced starts, and the path of equilibria by its arc
/// length through a snap onto a layer.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "condyle/equilibrium/arc_length.h"
#include "condyle/math/degree.h"
#include "equilibrium/displaced.h"
#include "support/layered_pairs.h"
#include "support/quadric_knee.h"
#include "support/random.h"
#include "support/truss.h"

namespace condyle {
namespace {

using test::Truss;

/// Up to 8 mm along each axis, 16 degrees about the flexion axis and 8 about the others.

class DisplacedStartsOnLayers : public testing::TestWithParam<unsigned> {};

// As the rigid knee does: the softer layers on the way bring them to one lattice too.
TEST_P(DisplacedStartsOnLayers, TwentyComeToOnePose) {
  Model knee = test::on_layers(test::quadric_knee());
  knee.conditions[0].value = 35 * kDegree;
  EquilibriumSolver reference(knee);
  const PoseResult expected = reference.solve();
  ASSERT_TRUE(expected.converged()) << expected.reason;
  test::Random random(GetParam());
  int lost = 0, elsewhere = 0;
  for (int trial = 0; trial < 20; ++trial) {
    Model model = knee;
    model.start = displaced(expected.X_BA, random);
    EquilibriumSolver solver(std::move(model));
    const PoseResult pose = solver.solve();
    lost += pose.converged() ? 0 : 1;
    const double moved = (pose.X_BA.p - expected.X_BA.p).norm(),
                 turned = (pose.X_BA.R - expected.X_BA.R).norm();
    elsewhere += pose.converged() && (moved > 1e-8 || turned > 1e-9) ? 1 : 0;
  }
  EXPECT_EQ(lost, 0);
  EXPECT_EQ(elsewhere, 0);
}

INSTANTIATE_TEST_SUITE_P(FiveTimes, DisplacedStartsOnLayers, testing::Values(1u, 2u, 3u, 4u, 5u));

/// Of the truss with the floor, on layers: a ball of 1 mm, pressed by π k R d² where it is d deep.
double floor_force(double z) {
  const double depth = std::max(0.0, -7 - z);
  return M_PI * test::kLayerStiffness * depth * depth;
}

// Through both limit points, then down onto the layer, and up again.
TEST(ArcLengthOnLayers, SnapsOntoALayerAndComesBack) {
  LayerOptions options;
  options.tolerance = 1e-5;
  EquilibriumSolver solver(test::on_layers(Truss::with_floor(), 10, options));
  const SweepResult down = follow_path(solver, load_scale(0), 0, 40, 1);
  for (const PoseResult& pose : down.poses) {
    ASSERT_TRUE(pose.converged()) << pose.value << ": " << pose.reason;
    const double z = pose.X_BA.p.z();
    // A light touch of few points is told with its error.
    const double error =
        pose.contacts[0].layer ? std::max(2e-3, 2 * pose.contacts[0].layer->error) : 0;
    EXPECT_NEAR(pose.value, Truss::load(z) + floor_force(z), 1e-9 + error * floor_force(z)) << z;
  }
  EXPECT_EQ(down.poses.back().value, 40);
  EXPECT_GT(floor_force(down.poses.back().X_BA.p.z()), 1);
  ASSERT_EQ(down.events.size(), 3u);
  EXPECT_EQ(down.events[0].kind, EventKind::kLimitPoint);
  EXPECT_EQ(down.events[1].kind, EventKind::kLimitPoint);
  EXPECT_EQ(down.events[2].kind, EventKind::kClosing);
  EXPECT_NEAR(down.events[2].value, Truss::load(-7), 1e-6);

  const SweepResult up = follow_path(solver, load_scale(0), 40, 10, 1);
  ASSERT_EQ(up.events.size(), 1u);
  EXPECT_EQ(up.events[0].kind, EventKind::kOpening);
  EXPECT_NEAR(up.events[0].value, Truss::load(-7), 1e-6);
  EXPECT_NEAR(Truss::load(up.poses.back().X_BA.p.z()), 10, 1e-10);
}

}  // namespace
}  // namespace condyle
