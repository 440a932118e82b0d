#include "scene/sweep_range.h"

#include <gtest/gtest.h>

#include <string>

#include "input_error.h"

namespace condyle {
namespace {

TEST(RangeValues, MeetTheEndWhereItIsAWholeNumberOfStepsAway) {
  const std::vector<double> values = range_values(0, 0.3, 0.1);
  ASSERT_EQ(values.size(), 4U);
  EXPECT_EQ(values.back(), 0.3);  // 3 * 0.1 is 0.30000000000000004
}

TEST(RangeValues, StopBeforeTheEndWhereItIsNot) {
  EXPECT_EQ(range_values(0, 12, 5), (std::vector<double>{0, 5, 10}));
}

TEST(RangeValues, GoDownwards) {
  EXPECT_EQ(range_values(10, 0, -5), (std::vector<double>{10, 5, 0}));
}

TEST(RangeValues, OfEqualEndsAreOne) { EXPECT_EQ(range_values(7, 7, 0), std::vector<double>{7}); }

TEST(RangeValues, HoldAMillionAndNotMore) {
  EXPECT_EQ(range_values(0, 999999, 1).size(), 1000000U);
  EXPECT_THROW((void)range_values(0, 1000000, 1), InputError);
}

TEST(RangeValues, ThatLeadNowhereSayWhy) {
  try {
    (void)range_values(90, 0, 5);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "step = 5, expected a step < 0 to get from 90 to 0");
  }
}

}  // namespace
}  // namespace condyle
