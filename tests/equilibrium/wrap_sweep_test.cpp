/// Ligaments that wrap, on the solver's road: closed forms, events, the way there and back, resuming, and
/// the derivatives that the solver relies on.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "condyle/equilibrium/build_model.h"
#include "condyle/equilibrium/sweep.h"
#include "condyle/math/rotation.h"
#include "condyle/scene_file/read_scene.h"
#include "support/wrapped_scenes.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

/// In the plane: from (-40, 0) to (40, y) over the circle of radius 10 about (0, -12).
struct Planar {
  double length, turn, e_y;  ///< [mm], [rad], of the unit tangent at the moving end
};
Planar planar(double y) {
  constexpr double kRadius = 10, kMiddle = -12;
  // Height over the line of the farthest point of the circle.
  const double line = std::hypot(80, y);
  const double distance = (40 * (0 - kMiddle) * 2 + 40 * y) / line;
  if (distance >= kRadius) return {line, 0, y / line};
  const double d1 = std::hypot(40, -kMiddle), d2 = std::hypot(40, y - kMiddle);
  const double l1 = std::sqrt(d1 * d1 - kRadius * kRadius),
               l2 = std::sqrt(d2 * d2 - kRadius * kRadius);
  const double first = std::atan2(-kMiddle, -40) - std::acos(kRadius / d1);
  const double last = std::atan2(y - kMiddle, 40) + std::acos(kRadius / d2);
  const double turn = first - last;
  return {l1 + l2 + kRadius * turn, turn, -std::cos(last)};
}

/// Where the line touches the circle: (40 y + 960)² = 100 (80² + y²).
double touching_y() { return (-76800 + std::sqrt(76800.0 * 76800 - 4 * 1500 * 281600.0)) / 3000; }

SweepResult swept(const Scene& scene, const SweepOptions& options = {}) {
  return sweep(scene, {}, options);
}

TEST(WrappedSweep, HasTheClosedFormsOfAStringOverAPost) {
  const Scene scene = parse_scene(test::kSlidingStrand, "knee.toml");
  const SweepResult result = swept(scene);
  ASSERT_EQ(result.count_converged(), 13);
  for (const PoseResult& pose : result.poses) {
    const Planar exact = planar(pose.value);
    EXPECT_NEAR(pose.ligaments[0].length, exact.length, 1e-11) << pose.value;
    const LineTouch& touch = pose.paths[0].touches[0];
    EXPECT_EQ(touch.touching, exact.turn > 0) << pose.value;
    EXPECT_NEAR(touch.turn, exact.turn, 1e-10);
    // What holds y carries the pull of the strand.
    EXPECT_NEAR(std::abs(pose.conditions[1].multiplier),
                std::abs(pose.ligaments[0].force * exact.e_y), 1e-9);
  }
}

// A string round a ball of 10 mm, its moving end held in all six freedoms: where that comes opposite
// to the other end, all great circles are as short, and no motion is left that could be the softest.
TEST(WrappedSweep, NamesThePathWhereNoMotionIsLeftToBlame) {
  std::string text = test::kWrappedHead + R"(
[[wrap]]
name = "ball"
body = "femur"
kind = "sphere"
center = [0, 0, 0]
radius = 10
[[ligament]]
name = "string"
ends = [{ body = "femur", at = [-20, 0, 5] }, { body = "tibia", at = [20, 0, 5] }]
wraps = ["ball"]
law = "quadratic"
stiffness = 1
slack_length = 10
)";
  for (const char* kind : {"translation", "rotation"})
    for (const char* axis : {"x", "y", "z"})
      text += fmt::format(
          "[[condition]]\nname = \"{0} {1}\"\nkind = \"{0}\"\naxis = \"{1}\"\nvalue = 0\n", kind,
          axis);
  text += "[sweep]\nvary = \"translation z\"\nfrom = -40\nto = 5\nstep = 1\n";
  const SweepResult result = swept(parse_scene(text, "knee.toml"));
  const PoseResult& opposite = result.poses[30];
  ASSERT_EQ(opposite.value, -10);
  EXPECT_FALSE(opposite.converged());
  EXPECT_NE(opposite.reason.find("ligament \"string\": its path over \"ball\""), std::string::npos)
      << opposite.reason;
  EXPECT_EQ(result.count_converged(), 45);
}

// Over a ball of 20 mm whose centre lies 0.8 mm beside the line, B = 3.2 mm of 90 (S12 of the checks);
// 10.8 mm beside it, half of L.
TEST(WrappedSweep, SaysWhereAPathIsCloseToAConjugatePoint) {
  Scene scene = parse_scene(test::kWrappedHead + R"(
[[wrap]]
name = "post"
body = "femur"
kind = "sphere"
center = [0, -0.8, 0]
radius = 20
)" + test::kSlidingStrand.substr(test::kSlidingStrand.find("[[ligament]]")),
                            "knee.toml");
  scene.sweep->values = {20, 0};
  const SweepResult result = swept(scene);
  ASSERT_EQ(result.count_converged(), 2);
  EXPECT_EQ(result.poses[0].remark.find("conjugate point"), std::string::npos);
  EXPECT_NE(result.poses[1].remark.find("ligament \"strand\": its path is close to a conjugate "
                                        "point"),
            std::string::npos)
      << result.poses[1].remark;
}

TEST(WrappedSweep, TellsWhereAStrandTouchesAndLiftsOff) {
  Scene scene = parse_scene(test::kSlidingStrand, "knee.toml");
  const SweepResult down = swept(scene);
  ASSERT_EQ(down.events.size(), 1U);
  EXPECT_EQ(down.events[0].kind, EventKind::kTouching);
  EXPECT_EQ(down.events[0].ligament, 0);
  EXPECT_EQ(down.events[0].wrap, 0);
  EXPECT_NEAR(down.events[0].value, touching_y(), 1e-8);
  std::reverse(scene.sweep->values.begin(), scene.sweep->values.end());
  const SweepResult up = swept(scene);
  ASSERT_EQ(up.events.size(), 1U);
  EXPECT_EQ(up.events[0].kind, EventKind::kLifting);
  EXPECT_NEAR(up.events[0].value, touching_y(), 1e-8);
}

TEST(WrappedSweep, IsTheSameUpAndDown) {
  Scene scene = parse_scene(test::kHangingBody, "knee.toml");
  const SweepResult up = swept(scene);
  std::reverse(scene.sweep->values.begin(), scene.sweep->values.end());
  const SweepResult down = swept(scene);
  const std::size_t n = up.poses.size();
  ASSERT_EQ(up.count_converged(), static_cast<int>(n));
  ASSERT_EQ(down.count_converged(), static_cast<int>(n));
  int touching = 0, open = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const PoseResult &a = up.poses[i], &b = down.poses[n - 1 - i];
    EXPECT_LT((a.X_BA.p - b.X_BA.p).norm(), 1e-9) << i;
    EXPECT_LT((a.X_BA.R - b.X_BA.R).norm(), 1e-10) << i;
    for (std::size_t k = 0; k < a.ligaments.size(); ++k) {
      EXPECT_NEAR(a.ligaments[k].length, b.ligaments[k].length, 1e-9) << i;
      ASSERT_EQ(a.paths[k].touches.size(), b.paths[k].touches.size());
      for (std::size_t w = 0; w < a.paths[k].touches.size(); ++w) {
        EXPECT_EQ(a.paths[k].touches[w].touching, b.paths[k].touches[w].touching) << i << " " << k;
        (a.paths[k].touches[w].touching ? touching : open) += 1;
      }
    }
  }
  EXPECT_GT(touching, 10);
  EXPECT_GT(open, 5);
  EXPECT_GT(up.events.size(), 1U);
  EXPECT_EQ(up.events.size(), down.events.size());
}

// Virtual work: the energy of the strands rises by what the loads do from pose to pose.
TEST(WrappedSweep, TheEnergyRisesByTheWorkOfTheLoads) {
  const Scene scene = parse_scene(test::kHangingBody, "knee.toml");
  const Model model = build_model(scene, {});
  EquilibriumSolver solver(model);
  Drive drive = drive_of(model);
  constexpr double h = 1e-4;
  const auto potential = [&](double scale) {
    drive.scales[1] = scale;
    const PoseResult pose = solver.solve(drive);
    EXPECT_TRUE(pose.converged());
    double energy = 0;
    for (std::size_t i = 0; i < scene.ligaments.size(); ++i)
      energy += tension(scene.ligaments[i].law, pose.ligaments[i].length).energy;
    const auto place = [&](const LoadDescription& load) { return Vector3d(pose.X_BA * load.at); };
    return std::pair{energy - scene.loads[0].vector.dot(place(scene.loads[0])),
                     scene.loads[1].vector.dot(place(scene.loads[1]))};
  };
  for (const double scale : {-1.6, -0.7, 0.3, 1.1, 1.9}) {
    const auto [before, from] = potential(scale - h);
    const auto [after, to] = potential(scale + h);
    EXPECT_NEAR(after - before, scale * (to - from), 1e-6 * std::abs(to - from)) << scale;
  }
}

TEST(WrappedSweep, TurnsWithTheWholeScene) {
  const Scene scene = parse_scene(test::kHangingBody, "knee.toml");
  Scene moved = scene;
  const RigidTransform X{exp_rotation({0.3, -0.5, 0.8}), {120, -340, 1500}};
  const int fixed = scene.fixed_body();
  for (WrapDescription& wrap : moved.wraps)
    if (wrap.body == fixed) wrap.placement = X * wrap.placement;
  for (LigamentDescription& ligament : moved.ligaments)
    for (Attachment& end : ligament.ends)
      if (end.body == fixed) end.at = X * end.at;
  for (LoadDescription& load : moved.loads) load.vector = X.R * load.vector;
  BodyDescription& body = moved.bodies[static_cast<std::size_t>(moved.moving_body())];
  body.start_translation = X.p;
  body.start_rotation = log_rotation(X.R);
  const SweepResult a = swept(scene), b = swept(moved);
  ASSERT_EQ(b.count_converged(), static_cast<int>(b.poses.size()));
  for (std::size_t i = 0; i < a.poses.size(); ++i) {
    const RigidTransform there = X * a.poses[i].X_BA;
    EXPECT_LT((there.p - b.poses[i].X_BA.p).norm(), 1e-8);
    for (std::size_t k = 0; k < a.poses[i].ligaments.size(); ++k)
      EXPECT_NEAR(a.poses[i].ligaments[k].force, b.poses[i].ligaments[k].force, 1e-7);
  }
}

TEST(WrappedSweep, ResumedIsTheOneThatWasNeverStopped) {
  const Scene scene = parse_scene(test::kHangingBody, "knee.toml");
  std::vector<KnownPose> computed;
  SweepOptions options;
  options.on_computed = [&](const KnownPose& pose) { computed.push_back(pose); };
  const SweepResult whole = swept(scene, options);
  for (const std::size_t stop : {1U, 7U, 12U}) {
    SweepOptions resumed;
    resumed.known.assign(computed.begin(), computed.begin() + static_cast<std::ptrdiff_t>(stop));
    const SweepResult result = swept(scene, resumed);
    ASSERT_EQ(result.poses.size(), whole.poses.size());
    for (std::size_t i = 0; i < whole.poses.size(); ++i) {
      EXPECT_LT((result.poses[i].X_BA.p - whole.poses[i].X_BA.p).norm(), 1e-9) << i;
      for (std::size_t k = 0; k < whole.poses[i].paths.size(); ++k)
        for (std::size_t w = 0; w < whole.poses[i].paths[k].touches.size(); ++w)
          EXPECT_EQ(result.poses[i].paths[k].touches[w].touching,
                    whole.poses[i].paths[k].touches[w].touching);
    }
    EXPECT_EQ(result.events.size(), whole.events.size());
  }
}

}  // namespace
}  // namespace condyle
