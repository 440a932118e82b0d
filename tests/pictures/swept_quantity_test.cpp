#include "pictures/swept_quantity.h"

#include <gtest/gtest.h>

#include "pictures/block_knee.h"

namespace condyle {
namespace {

TEST(SweptQuantity, FlexionIsShownInDegrees) {
  const SweptQuantity swept = swept_quantity(block_scene(1));
  EXPECT_TRUE(swept.flexion);
  EXPECT_EQ(with_unit(swept, 0.5235987755982988), "30°");
  EXPECT_EQ(with_unit(swept, -1e-9), "0°");
}

TEST(SweptQuantity, AFactorOnALoadHasTheNameOfTheLoad) {
  Scene scene = block_scene(1);
  scene.loads.resize(1);
  scene.loads[0].name = "body weight";
  scene.sweep = SweepDescription{true, 0, "body weight.scale", {0.0, 1.5}};
  const SweptQuantity swept = swept_quantity(scene);
  EXPECT_EQ(swept.title, "Factor on body weight");
  EXPECT_EQ(with_unit(swept, 1.5), "1.5×");
}

}  // namespace
}  // namespace condyle
