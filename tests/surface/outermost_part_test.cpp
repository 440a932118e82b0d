/// Of two sheets over each other the outer one, whichever is larger and comes first.

#include "condyle/surface/outermost_part.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/mesh_shapes.h"

namespace condyle {
namespace {

/// A hollow plateau, and a sheet 2 mm over its middle.
TriangleMesh plateau(double side, double height) {
  return test::height_sheet(side, static_cast<int>(side),
                            [=](double x, double y) { return height + (x * x + y * y) / 200; });
}

OutermostPart of(const TriangleMesh& first, const TriangleMesh& second) {
  TriangleMesh both = first;
  test::append(both, second);
  return outermost_part(both, std::vector<bool>(both.triangles.size(), true));
}

std::ptrdiff_t kept_of_first(const OutermostPart& part, const TriangleMesh& first) {
  return std::count(part.keep.begin(),
                    part.keep.begin() + static_cast<std::ptrdiff_t>(first.triangles.size()), true);
}

TEST(OutermostPart, IsTheSheetOverTheOther) {
  const TriangleMesh bone = plateau(40, 0), cartilage = plateau(30, 2);
  const auto size = static_cast<std::ptrdiff_t>(cartilage.triangles.size());
  const OutermostPart one = of(bone, cartilage), other = of(cartilage, bone);
  EXPECT_EQ(kept_of_first(one, bone), 0);
  EXPECT_EQ(std::count(one.keep.begin(), one.keep.end(), true), size);
  EXPECT_EQ(kept_of_first(other, cartilage), size);
  EXPECT_EQ(std::count(other.keep.begin(), other.keep.end(), true), size);
  EXPECT_NEAR(one.below, 2, 0.1);
  EXPECT_NEAR(other.below, 2, 0.1);
}

TEST(OutermostPart, IsTheLargestWhereNothingLiesOverIt) {
  const TriangleMesh large = plateau(40, 0);
  TriangleMesh beside = plateau(30, 2), far = plateau(30, 20), small = plateau(12, 2);
  for (Eigen::Vector3d& p : beside.vertices) p.x() += 40;
  for (const TriangleMesh& other : {beside, far, small}) {
    const OutermostPart part = of(large, other);
    EXPECT_EQ(kept_of_first(part, large), static_cast<std::ptrdiff_t>(large.triangles.size()));
    EXPECT_EQ(std::count(part.keep.begin(), part.keep.end(), true),
              static_cast<std::ptrdiff_t>(large.triangles.size()));
  }
  EXPECT_EQ(of(large, beside).below, 0);
  EXPECT_EQ(of(large, far).below, 0);
}

}  // namespace
}  // namespace condyle
