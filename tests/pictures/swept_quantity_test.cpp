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

TEST(SweptQuantity, FindsTheNearestPose) {
  const auto run = block_run();  // 0, 28.6 and 57.3 degrees
  EXPECT_EQ(nearest_pose(run.scene, run.sweep, -5), 0u);
  EXPECT_EQ(nearest_pose(run.scene, run.sweep, 30), 1u);
  EXPECT_EQ(nearest_pose(run.scene, run.sweep, 1000), 2u);
  EXPECT_FALSE(nearest_pose(run.scene, {}, 0).has_value());
}

}  // namespace
}  // namespace condyle
