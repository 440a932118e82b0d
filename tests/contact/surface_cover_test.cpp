#include "condyle/contact/surface_cover.h"

#include <gtest/gtest.h>

#include "support/bumpy_patches.h"
#include "support/random.h"

namespace condyle::test {
namespace {

int nearest_of_all(const SurfaceCover& cover, const Eigen::Vector3d& p) {
  int nearest = 0;
  for (int i = 1; i < cover.size(); ++i)
    if ((cover.sample(i).c - p).norm() < (cover.sample(nearest).c - p).norm()) nearest = i;
  return nearest;
}

// Points over the patch and up to 8 mm beside it, each begun from where the one before was found.
TEST(SurfaceCover, FindsTheNearestSampleAndKeepsItWhereItIsNotNear) {
  Random random(3);
  const auto patch = bumpy_patch(0.03, 0.02, Roughness(random, 0.1), 1.6, false);
  const SurfaceCover cover(*patch, 1.2);
  int from = -1, beyond = 0;
  long looked_at = 0;
  for (int k = 0; k < 500; ++k) {
    const Eigen::Vector3d p(random.between(-20, 20), random.between(-18, 18),
                            random.between(-3, 3));
    int anywhere = -1;
    const int found = cover.nearest(p, anywhere, looked_at);
    EXPECT_EQ(anywhere, nearest_of_all(cover, p));
    EXPECT_TRUE(found == anywhere || found == -1);
    EXPECT_EQ(cover.nearest(p, from, looked_at) < 0, found < 0);
    if (found >= 0) continue;
    ++beyond;
    EXPECT_EQ(from, anywhere);
  }
  EXPECT_GT(beyond, 100);
  EXPECT_LT(beyond, 400);
}

}  // namespace
}  // namespace condyle::test
