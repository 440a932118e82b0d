#include "condyle/scene/sweep_range.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <string>

#include "condyle/input_error.h"

namespace condyle {
namespace {

TEST(RangeValues, MeetTheEndWhereItIsAWholeNumberOfStepsAway) {
  const std::vector<double> values = range_values({0, 0.3, 0.1});
  ASSERT_EQ(values.size(), 4U);
  EXPECT_EQ(values.back(), 0.3);  // 3 * 0.1 is 0.30000000000000004
}

TEST(RangeValues, StopBeforeTheEndWhereItIsNot) {
  EXPECT_EQ(range_values({0, 12, 5}), (std::vector<double>{0, 5, 10}));
}

// 15 * (pi / 180) / (pi / 180) is 14.999999999999998.
TEST(InUnit, GivesBackWhatAUserWrote) {
  const Unit degree{"deg", M_PI / 180};
  for (int i = -3600; i <= 3600; ++i)
    ASSERT_EQ(in_unit(0.1 * i * degree.factor, degree),
              std::strtod(fmt::format("{:.1f}", 0.1 * i).c_str(), nullptr));
  const double located = 15.000000000001234 * degree.factor;  // of an event, not typed by anybody
  EXPECT_EQ(in_unit(located, degree), located / degree.factor);
  EXPECT_TRUE(std::isnan(in_unit(std::nan(""), degree)));
}

TEST(RangeValues, GoDownwards) {
  EXPECT_EQ(range_values({10, 0, -5}), (std::vector<double>{10, 5, 0}));
}

TEST(RangeValues, OfEqualEndsAreOne) { EXPECT_EQ(range_values({7, 7, 0}), std::vector<double>{7}); }

TEST(RangeValues, HoldAMillionAndNotMore) {
  EXPECT_EQ(range_values({0, 999999, 1}).size(), 1000000U);
  EXPECT_THROW((void)range_values({0, 1000000, 1}), InputError);
}

// A step below the spacing of doubles there would visit some values twice and leave out others.
TEST(RangeValues, AreAllDifferent) {
  EXPECT_THROW((void)range_values({90, 90 + 1e-9, 1e-14}), InputError);
  EXPECT_THROW((void)range_values({99999999999999990.0, 1e17, 1}), InputError);
  EXPECT_THROW((void)range_values({0, 1e-12, 1e-13}), InputError);
  const std::vector<double> values = range_values({1, 1 + 1e-5, 2e-6});
  ASSERT_EQ(values.size(), 6U);
  for (std::size_t i = 1; i < values.size(); ++i) EXPECT_GT(values[i], values[i - 1]);
}

TEST(RangeValues, ThatLeadNowhereSayWhy) {
  try {
    (void)range_values({90, 0, 5});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "step = 5, expected a step < 0 to get from 90 to 0");
  }
}

}  // namespace
}  // namespace condyle
