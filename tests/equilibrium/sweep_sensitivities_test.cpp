/// Derivatives at the poses of a sweep by the numbers that its scene asks for.

#include "condyle/equilibrium/sweep_sensitivities.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "condyle/equilibrium/sweep.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/specimen/fit_surfaces.h"
#include "support/allocation_count.h"
#include "support/instruction_count.h"

namespace condyle {
namespace {

Scene wismans_type(const std::string& names) {
  Scene scene =
      read_scene(std::filesystem::path(CONDYLE_SOURCE_DIR) / "data/wismans-type/knee.toml");
  std::string text = scene.text;
  if (!names.empty()) text += "sensitivities = [" + names + "]\n";
  return parse_scene(text, "knee.toml");
}

struct SweptKnee {
  Scene scene;
  std::vector<FittedSurface> surfaces;
  SweepResult result;
};

SweptKnee swept(const std::string& names) {
  Scene scene = wismans_type(names);
  std::vector<FittedSurface> surfaces = fit_surfaces(scene);
  SweepResult result = sweep(scene, surfaces);
  return {std::move(scene), std::move(surfaces), std::move(result)};
}

std::size_t output_named(const SweepSensitivities& s, const std::string& place) {
  const auto found = std::find_if(s.outputs.begin(), s.outputs.end(),
                                  [&](const SensitivityOutput& o) { return o.place == place; });
  EXPECT_NE(found, s.outputs.end()) << place;
  return static_cast<std::size_t>(found - s.outputs.begin());
}

// The slope of each curve over flexion is the derivative by the flexion: the drawer moves by its
// integral, and the flexion itself follows exactly.
TEST(SweepSensitivities, ByTheSweptValueAreTheSlopesOfTheCurves) {
  SweptKnee knee = swept("\"flexion.value\"");
  knee.scene.sweep->values.clear();
  for (int degree = 0; degree <= 90; ++degree)
    knee.scene.sweep->values.push_back(degree * M_PI / 180);
  knee.result = sweep(knee.scene, knee.surfaces);
  const auto s = sweep_sensitivities(knee.scene, knee.surfaces, knee.result.poses);
  ASSERT_TRUE(s);
  const std::size_t flexion = output_named(*s, "joint/flexion"),
                    drawer = output_named(*s, "joint/anterior_drawer");
  ASSERT_EQ(s->by_pose.size(), knee.result.poses.size());
  double integral = 0;
  for (std::size_t i = 0; i < s->by_pose.size(); ++i) {
    ASSERT_TRUE(knee.result.poses[i].converged());
    EXPECT_NEAR(s->by_pose[i](static_cast<Eigen::Index>(flexion), 0), 1, 1e-9);
    const double weight = i == 0 || i + 1 == s->by_pose.size() ? 0.5 : 1;
    integral += weight * M_PI / 180 * s->by_pose[i](static_cast<Eigen::Index>(drawer), 0);
  }
  const double moved = knee.result.poses.back().joint.anterior_drawer -
                       knee.result.poses.front().joint.anterior_drawer;
  EXPECT_NEAR(integral, moved, 2e-3 * std::abs(moved));  // trapezium rule in steps of 1 degree
}

TEST(SweepSensitivities, WhereAPoseIsLostThereAreNone) {
  SweptKnee knee = swept("\"*.slack_length\"");
  knee.result.poses[3].status = PoseStatus::kIterationLimit;
  const auto s = sweep_sensitivities(knee.scene, knee.surfaces, knee.result.poses);
  EXPECT_EQ(s->parameters.size(), knee.scene.ligaments.size());
  EXPECT_TRUE(s->by_pose[2].allFinite());
  EXPECT_TRUE(s->by_pose[3].array().isNaN().all());
  EXPECT_TRUE(s->by_pose[4].allFinite());
}

// The sweep knows nothing of them; what comes after it builds and computes nothing.
TEST(SweepSensitivities, CostNothingWhereNobodyAsks) {
  const SweptKnee knee = swept("");
  const auto ask = [&] {
    return sweep_sensitivities(knee.scene, knee.surfaces, knee.result.poses);
  };
  const test::AllocationCount count;
  EXPECT_FALSE(ask());
  if (test::allocations_are_counted()) {
    EXPECT_EQ(count.since_start(), 0);
  }
  if (const std::optional<long> instructions = test::count_instructions([&] { (void)ask(); })) {
    EXPECT_LT(*instructions, 1000);
  }
}

TEST(SceneParameters, AVectorIsThreeAndAnInsertionHoldsWhatTheLigamentIsDescribedBy) {
  const Scene scene = wismans_type(R"("aACL.insertion.tibia", "pACL.stiffness", "flexion.value")");
  const std::vector<SceneParameter> found = scene_parameters(scene, scene.sweep->sensitivities);
  ASSERT_EQ(found.size(), 5U);
  EXPECT_EQ(found[1].name, "aACL.insertion.tibia.y");
  ASSERT_EQ(found[1].parts.size(), 1U);
  EXPECT_EQ(found[1].parts[0],
            (ModelParameter{ParameterKind::kInsertion, 0, OfBody::kMoving, 1, Held::kSlackLength}));
  EXPECT_EQ(found[3].unit.name, "N");
  EXPECT_EQ(found[4].unit.name, "deg");
  Scene by_strain = scene;
  by_strain.ligaments[0].reference_strain = 0.02;
  EXPECT_EQ(scene_parameters(by_strain, scene.sweep->sensitivities)[0].parts[0].held,
            Held::kReferenceStrain);
}

}  // namespace
}  // namespace condyle
