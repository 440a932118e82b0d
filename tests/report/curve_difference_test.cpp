/// How far curves are from each other, by numbers that can be reckoned in the head.

#include "condyle/report/curve_difference.h"

#include <gtest/gtest.h>

#include <cmath>

namespace condyle {
namespace {

const double kNone = std::nan("");

TEST(CurveDifference, OfTheSamePlacesIsTakenPointByPoint) {
  const auto d = difference({{0, 1, 2}, {1, 1, 1}}, {{0, 1, 2}, {1, 4, -3}});
  ASSERT_TRUE(d);
  EXPECT_EQ(d->largest, -4);  // with its sign: second minus first
  EXPECT_EQ(d->at, 2);
  EXPECT_EQ(d->count, 3);
  EXPECT_EQ(d->interpolated, 0);
  EXPECT_DOUBLE_EQ(d->rms, std::sqrt((0 + 9 + 16) / 3.0));
}

TEST(CurveDifference, OfOtherPlacesIsStraightBetweenNeighbours) {
  // 2x against x² at 0, 1, 2, 3 (0, 1, 4, 9), known at 0, 3: 2x is exact, x² at its points.
  const auto d = difference({{0, 3}, {0, 6}}, {{0, 1, 2, 3}, {0, 1, 4, 9}});
  ASSERT_TRUE(d);
  EXPECT_EQ(d->count, 4);
  EXPECT_EQ(d->interpolated, 2);
  EXPECT_EQ(d->largest, 3);
  EXPECT_EQ(d->at, 3);
  EXPECT_DOUBLE_EQ(d->rms, std::sqrt((0 + 1 + 0 + 9) / 4.0));
}

TEST(CurveDifference, IsNeverTakenAcrossAGapOrBeyondAnEnd) {
  // At 1 the first has no value; at 0.5 and 1.5 it would lie across the gap; at 5 beyond its end.
  const auto d =
      difference({{0, 1, 2, 3}, {0, kNone, 0, 0}}, {{0.5, 1, 1.5, 2.5, 5}, {9, 9, 9, 7, 9}});
  ASSERT_TRUE(d);
  EXPECT_EQ(d->largest, 8);
  EXPECT_EQ(d->at, 2);
  EXPECT_EQ(d->count, 3) << "at 2, 2.5 and 3, where the second is straight between 1.5, 2.5 and 5";
  const auto broken = difference({{0, kNone, 2}, {0, kNone, 0}}, {{1}, {5}});
  ASSERT_TRUE(broken);
  EXPECT_EQ(broken->count, 0);
}

TEST(CurveDifference, KnowsCurvesThatRunDownwardsAndRefusesThoseThatTurnBack) {
  const auto down = difference({{0, 1, 2}, {0, 1, 2}}, {{2, 1.5, kNone, 0}, {2, 1, kNone, 1}});
  ASSERT_TRUE(down);
  EXPECT_EQ(down->count, 3) << "at 0, 1.5 and 2; 1 lies across the gap";
  EXPECT_EQ(down->largest, 1);
  EXPECT_EQ(down->at, 0);
  EXPECT_FALSE(difference({{0, 1, 0.5}, {0, 0, 0}}, {{0, 1}, {0, 0}}));
  EXPECT_FALSE(difference({{0, 1}, {0, 0}}, {{0, 0, 1}, {0, 1, 0}}));
}

TEST(CurveDifference, TakesPlacesThatRoundingPartedAsTheSame) {
  const auto d = difference({{15}, {1}}, {{14.999999999999998}, {2}});
  ASSERT_TRUE(d);
  EXPECT_EQ(d->count, 1);
  EXPECT_EQ(d->interpolated, 0);
  EXPECT_TRUE(same_places({15, 30}, {14.999999999999998, 30}));
  EXPECT_FALSE(same_places({15, 30}, {15}));
  EXPECT_FALSE(same_places({15}, {15.1}));
}

}  // namespace
}  // namespace condyle
