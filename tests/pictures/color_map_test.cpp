#include "condyle/pictures/color_map.h"

#include <gtest/gtest.h>

#include <cmath>

#include "condyle/results/strain_scale.h"

namespace condyle {
namespace {

double lightness(Rgb c) {
  const auto linear = [](std::uint8_t v) { return std::pow(v / 255.0, 2.2); };
  return 0.2126 * linear(c[0]) + 0.7152 * linear(c[1]) + 0.0722 * linear(c[2]);
}

TEST(ColorMap, GetsLighterAllTheWaySoThatItReadsInGrey) {
  for (const ColorMap map : {ColorMap::kStrain, ColorMap::kFlexion}) {
    for (int i = 0; i < 50; ++i)
      EXPECT_LT(lightness(map_color(map, i / 50.0)), lightness(map_color(map, (i + 1) / 50.0)))
          << i;
  }
}

TEST(ColorMap, OfPressureGetsDarkerAllTheWay) {
  for (int i = 0; i < 50; ++i)
    EXPECT_GT(lightness(map_color(ColorMap::kPressure, i / 50.0)),
              lightness(map_color(ColorMap::kPressure, (i + 1) / 50.0)))
        << i;
}

TEST(ColorMap, OfBothSignsIsLightestInTheMiddleAndBlueBelow) {
  for (int i = 0; i < 25; ++i) {
    EXPECT_LT(lightness(map_color(ColorMap::kDiverging, i / 50.0)),
              lightness(map_color(ColorMap::kDiverging, (i + 1) / 50.0)));
    EXPECT_LT(lightness(map_color(ColorMap::kDiverging, 1 - i / 50.0)),
              lightness(map_color(ColorMap::kDiverging, 1 - (i + 1) / 50.0)));
  }
  const Rgb low = map_color(ColorMap::kDiverging, 0.1), high = map_color(ColorMap::kDiverging, 0.9);
  EXPECT_GT(low[2], low[0] + 80);
  EXPECT_GT(high[0], high[2] + 80);
}

TEST(ColorMap, ClampsAndSurvivesNotANumber) {
  EXPECT_EQ(map_color(ColorMap::kStrain, -3), map_color(ColorMap::kStrain, 0));
  EXPECT_EQ(map_color(ColorMap::kStrain, 7), map_color(ColorMap::kStrain, 1));
  EXPECT_EQ(map_color(ColorMap::kFlexion, std::nan("")), map_color(ColorMap::kFlexion, 0));
}

TEST(ColorMap, RoundsScalesUpToNiceNumbers) {
  EXPECT_DOUBLE_EQ(round_up_nicely(0.083), 0.1);
  EXPECT_DOUBLE_EQ(round_up_nicely(0.1), 0.1);
  EXPECT_DOUBLE_EQ(round_up_nicely(130), 150);
  EXPECT_DOUBLE_EQ(round_up_nicely(2.1), 2.5);
  EXPECT_DOUBLE_EQ(round_up_nicely(8.5), 10);
}

}  // namespace
}  // namespace condyle
