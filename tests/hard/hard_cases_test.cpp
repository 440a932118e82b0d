/// Scenes that are hard on a solver (data/hard): nothing crashes, hangs or is wrong and called
/// converged. docs/accuracy.md prints the table.

#include "support/hard_cases.h"

#include <gtest/gtest.h>

#include <cctype>
#include <string>

namespace condyle::hard {

void PrintTo(const HardCase& hard, std::ostream* out) { *out << hard.name; }

namespace {

class HardCases : public testing::TestWithParam<HardCase> {};

TEST_P(HardCases, BehaveAsExpected) {
  const HardCase& hard = GetParam();
  const HardOutcome outcome = run(hard, CONDYLE_SOURCE_DIR);
  EXPECT_TRUE(outcome.as_expected(hard))
      << outcome.statuses << " in place of " << hard.expected << ": " << hard.wanted;
  EXPECT_TRUE(outcome.finite);
  EXPECT_TRUE(outcome.has_words) << hard.words;
  EXPECT_LE(outcome.error, hard.tolerance) << hard.wanted;
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

TEST(HardCases, EachHasATruthUnlessNothingIsToConverge) {
  for (const HardCase& hard : hard_cases())
    EXPECT_TRUE(hard.error || hard.steps > 0 || hard.expected.find('c') == std::string::npos)
        << hard.name;
}

}  // namespace
}  // namespace condyle::hard
