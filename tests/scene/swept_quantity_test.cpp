#include "condyle/scene/swept_quantity.h"

#include <gtest/gtest.h>

#include <cmath>

#include "condyle/scene_file/read_scene.h"
#include "scene/small_scene.h"

namespace condyle {
namespace {

TEST(SweptQuantity, FlexionIsShownInDegreesWhateverTheScenesUnit) {
  const SweptQuantity swept = quantity_of_sweep(parse_scene(kSmallScene, "knee.toml"));
  EXPECT_TRUE(swept.flexion);
  EXPECT_EQ(swept.condition, 0);
  EXPECT_EQ(swept.heading(), "bend [deg]");  // as the scene names it
  EXPECT_EQ(swept.axis, "Flexion [°]");
  EXPECT_DOUBLE_EQ(swept.axis_per_inside, 180 / M_PI);
  EXPECT_EQ(with_unit(swept, M_PI / 6), "30°");
  EXPECT_EQ(with_unit(swept, -1e-9), "0°");
  EXPECT_EQ(swept.shown(15 * (M_PI / 180)), 15);  // no digits of the way to radians and back
}

TEST(SweptQuantity, AnAngleIsDeclaredInTheUnitOfTheScene) {
  Scene scene = parse_scene(kSmallScene, "knee.toml");
  scene.angle_to_rad = 1;
  EXPECT_EQ(quantity_of_sweep(scene).declared.name, "rad");
  EXPECT_EQ(quantity_of_sweep(scene).unit.name, "deg");
}

TEST(SweptQuantity, AConditionWithoutANameOfTheFieldGoesByItsOwn) {
  Scene scene = parse_scene(kSmallScene, "knee.toml");
  scene.conditions[0].kind = ConditionKind::kTranslation;
  scene.length_to_mm = 10;
  const SweptQuantity swept = quantity_of_sweep(scene);
  EXPECT_EQ(swept.title, "bend");
  EXPECT_EQ(swept.inside, "bend");
  EXPECT_EQ(swept.unit.name, "mm");
  EXPECT_EQ(swept.declared.name, "cm");
  EXPECT_DOUBLE_EQ(swept.declared.factor, 10);
  EXPECT_FALSE(swept.flexion);
}

TEST(SweptQuantity, AFactorOnALoadHasTheNameAndOnAnAxisTheSizeOfTheLoad) {
  Scene scene = parse_scene(kSmallScene, "knee.toml");
  scene.loads.resize(1);
  scene.loads[0].name = "body weight";
  scene.loads[0].moment = false;
  scene.loads[0].vector = {0, 300, 400};  // N
  scene.sweep = SweepDescription{true, 0, "body weight.scale", {0.0, 1.5}};
  SweptQuantity swept = quantity_of_sweep(scene);
  EXPECT_EQ(swept.title, "Factor on body weight");
  EXPECT_EQ(swept.heading(), "body weight.scale");
  EXPECT_EQ(swept.unit_after_number(), "");
  EXPECT_EQ(with_unit(swept, 1.5), "1.5×");
  EXPECT_EQ(swept.axis, "body weight [N]");
  EXPECT_DOUBLE_EQ(swept.axis_per_inside, 500);
  scene.loads[0].vector.setZero();
  EXPECT_DOUBLE_EQ(quantity_of_sweep(scene).axis_per_inside, 1);
}

TEST(SweptQuantity, AMotionGoesOverTime) {
  EXPECT_EQ(quantity_of_motion().heading(), "time [s]");
  EXPECT_EQ(with_unit(quantity_of_motion(), 0.25), "0.25 s");
}

}  // namespace
}  // namespace condyle
