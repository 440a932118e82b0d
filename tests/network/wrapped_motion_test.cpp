/// Motions of a body that hangs on strands over surfaces of either body: its energy, while strands touch
/// and leave.

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <set>
#include <vector>

#include "condyle/equilibrium/build_model.h"
#include "condyle/equilibrium/pose_result.h"
#include "condyle/network/integrate.h"
#include "condyle/network/knee_network.h"
#include "condyle/network/moving_network.h"
#include "condyle/scene_file/read_scene.h"
#include "network/integration_options.h"
#include "support/wrapped_scenes.h"

namespace condyle {
namespace {

/// In t, mm and s.
KneeNetwork hanging_body(const Model& model) {
  MassProperties mass;
  mass.mass = 2e-4;
  mass.center = {0, -65, 0};
  mass.inertia = Eigen::Vector3d(0.1, 0.08, 0.12).asDiagonal();
  return make_knee_network(model, mass);
}

NetworkState thrown_sideways(const Model& model) {
  NetworkState state;
  state.bodies = {{model.start, {150, 40, -60}, {0, 0, 4}}};
  return state;
}

Motion thrown(const Model& model, double viscous_time, double time) {
  KneeNetwork knee = hanging_body(model);
  for (LineComponent& line : knee.network.lines) line.viscous_time = viscous_time;
  return integrate(knee.network, thrown_sideways(model), options(time, 0.005, 1e-11));
}

TEST(WrappedMotion, KeepsItsEnergyWhileStrandsTouchAndLeave) {
  const Scene scene = parse_scene(test::kHangingBody, "knee.toml");
  const Model model = build_model(scene, {});
  for (const double viscous_time : {0.0, 2e-3}) {
    const Motion motion = thrown(model, viscous_time, 0.12);
    ASSERT_TRUE(motion.completed) << motion.reason;
    EXPECT_LT(motion.largest_imbalance, 1e-8 * motion.energy_scale);
    std::set<std::size_t> touched, left;
    for (const MotionFrame& frame : motion.frames) {
      PoseResult pose;
      begin_pose({frame.state.bodies[0].X, nullptr, model.elements, frame.paths, 0}, pose);
      for (std::size_t i = 0; i < pose.paths.size(); ++i) {
        EXPECT_NEAR(pose.ligaments[i].length, frame.lines[i].length, 1e-9);
        for (const LineTouch& touch : pose.paths[i].touches)
          (touch.touching ? touched : left).insert(i);
      }
    }
    std::set<std::size_t> both;
    for (const std::size_t strand : touched)
      if (left.count(strand) > 0) both.insert(strand);
    EXPECT_GE(both.size(), 1U) << "no strand touched and left";
    EXPECT_EQ(motion.frames.back().dissipated > 0, viscous_time > 0);
  }
}

// What is taken back leaves no trace in how strands lie: the same stretch again has the same bits.
TEST(WrappedMotion, AStretchThatIsRepeatedGoesOnFromHowStrandsLayBeforeIt) {
  const Scene scene = parse_scene(test::kHangingBody, "knee.toml");
  const Model model = build_model(scene, {});
  const KneeNetwork knee = hanging_body(model);
  MovingNetwork moving(knee.network, thrown_sideways(model), options(0.2, 0.005, 1e-9));
  std::vector<ContactEvent> events;
  moving.check_start();
  ASSERT_TRUE(moving.change_contacts({}, {}, events));
  moving.restart(0);
  const auto paths_at = [&](double from, double to) {
    for (double t = from; t < to;) (void)moving.ode().advance(t, to, to);
    const std::vector<double> paths = moving.moment(to).paths;
    std::vector<std::uint64_t> bits(paths.size());
    std::memcpy(bits.data(), paths.data(), sizeof(double) * paths.size());
    return bits;
  };
  (void)paths_at(0, 0.02);
  const MovingNetwork::Moment before = moving.moment(0.02);
  moving.go_back(before);  // from here the steps are taken anew
  const auto first = paths_at(0.02, 0.1);
  ASSERT_FALSE(first.empty());
  moving.go_back(before);
  EXPECT_EQ(paths_at(0.02, 0.1), first);
}

// It turns until a strand slips off the end of the egg: the path that it held is the shortest no more. Rounding
// says whether another one is found from there, with a loss of energy, or none.
TEST(WrappedMotion, EndsOrLosesEnergyWhereAStrandSlipsOff) {
  const Scene scene = parse_scene(test::kHangingBody, "knee.toml");
  const Motion motion = thrown(build_model(scene, {}), 0, 0.5);
  if (motion.completed)
    EXPECT_GT(motion.largest_imbalance, 2e-3 * motion.energy_scale);
  else
    EXPECT_NE(motion.reason.find("line \"both\" has no shortest path"), std::string::npos)
        << motion.reason;
}

}  // namespace
}  // namespace condyle
