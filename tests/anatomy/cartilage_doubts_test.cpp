/// Cartilage that lies in its bone, or far over it, is doubted.

#include "condyle/anatomy/cartilage_doubts.h"

#include <gtest/gtest.h>

#include "support/mesh_shapes.h"

namespace condyle {
namespace {

/// A sheet of cartilage at a height [mm] over the upper face of a cube of 60 mm, whose lower bone has none.
std::vector<std::string> doubts_at(double height) {
  TriangleMesh sheet = test::height_sheet(40, 10, [&](double, double) { return 60 + height; });
  for (Eigen::Vector3d& p : sheet.vertices) p += Eigen::Vector3d(30, 30, 0);
  KneeMeshes meshes{test::cube(60), test::cube(60, {0, 0, 80}), std::move(sheet), {}};
  RecognisedKnee shape;
  shape.femur.width = shape.tibia.width = 80;
  return cartilage_doubts(meshes, shape);
}

TEST(CartilageDoubts, AreOfWhatLiesInTheBoneOrFarOverIt) {
  const std::string ask = "is it of this knee, and in one frame with it?";
  EXPECT_TRUE(doubts_at(2).empty());
  EXPECT_TRUE(doubts_at(-0.4).empty());
  EXPECT_EQ(doubts_at(-2), std::vector<std::string>{"100 % of the femoral cartilage lies more than "
                                                    "0.5 mm deep in its bone: " +
                                                    ask});
  EXPECT_EQ(doubts_at(7), std::vector<std::string>{"100 % of the femoral cartilage lies more than "
                                                   "6.0 mm over its bone: " +
                                                   ask});
}

// Of a bone that is open nothing can be told.
TEST(CartilageDoubts, NeedABoneThatEnclosesAVolume) {
  const TriangleMesh sheet = test::height_sheet(40, 10, [](double, double) { return 0.; });
  RecognisedKnee shape;
  shape.femur.width = shape.tibia.width = 80;
  EXPECT_TRUE(cartilage_doubts({sheet, sheet, sheet, sheet}, shape).empty());
}

}  // namespace
}  // namespace condyle
