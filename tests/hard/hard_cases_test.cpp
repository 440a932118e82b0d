/// Scenes that are hard on a solver (data/hard): nothing crashes, hangs or is wrong and called
/// converged. docs/accuracy.md prints the table.

#include "hard/hard_cases.h"

#include <gtest/gtest.h>

#include <cctype>

#include "equilibrium/sweep.h"
#include "scene/read_scene.h"

namespace condyle::hard {

void PrintTo(const HardCase& hard, std::ostream* out) { *out << hard.name; }

namespace {

class HardCases : public testing::TestWithParam<HardCase> {};

TEST_P(HardCases, BehaveAsExpected) {
  const HardCase& hard = GetParam();
  const HardOutcome outcome = run(hard, CONDYLE_SOURCE_DIR);
  if (!hard.expected.empty()) {
    EXPECT_EQ(outcome.statuses, hard.expected) << hard.why;
  }
  EXPECT_TRUE(outcome.finite);
  EXPECT_TRUE(outcome.has_words) << hard.words;
  EXPECT_LE(outcome.error, hard.tolerance) << hard.why;
  for (const PoseResult& pose : outcome.sweep.poses)
    EXPECT_EQ(pose.converged(), pose.reason.empty());
}

std::string name_of(const testing::TestParamInfo<HardCase>& info) {
  std::string name;
  for (const char c : info.param.name)
    name += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(Table, HardCases, testing::ValuesIn(hard_cases()), name_of);

TEST(HardCases, OneStepOf120DegreesEndsWhereSmallStepsDo) {
  const auto file = std::filesystem::path(CONDYLE_SOURCE_DIR) / "data/hard/one-step.toml";
  Scene scene = read_scene(file);
  const std::vector<FittedSurface> surfaces = fit_surfaces(scene);
  const PoseResult once = sweep(scene, surfaces).poses.back();
  scene.sweep->values.clear();
  for (int k = 0; k <= 24; ++k) scene.sweep->values.push_back(5 * k * M_PI / 180);
  const PoseResult steps = sweep(scene, surfaces).poses.back();
  ASSERT_TRUE(once.converged() && steps.converged());
  EXPECT_LT((once.X_BA.p - steps.X_BA.p).norm(), 1e-9);
  EXPECT_LT((once.X_BA.R - steps.X_BA.R).norm(), 1e-10);
}

}  // namespace
}  // namespace condyle::hard
