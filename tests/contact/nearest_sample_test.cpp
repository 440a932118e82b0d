#include "condyle/contact/nearest_sample.h"

#include <gtest/gtest.h>

#include "condyle/surface/exact_surfaces.h"
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
TEST(NearestSample, IsFoundAndKeptWhereItIsNotNear) {
  Random random(3);
  const auto patch = bumpy_patch(0.03, 0.02, Roughness(random, 0.1), 1.6, false);
  const SurfaceCover cover(*patch, 1.2);
  NearestSample samples(cover);
  int from = -1, beyond = 0;
  long looked_at = 0;
  for (int k = 0; k < 500; ++k) {
    const Eigen::Vector3d p(random.between(-20, 20), random.between(-18, 18),
                            random.between(-3, 3));
    int anywhere = -1;
    const int found = samples.find(p, anywhere, looked_at);
    EXPECT_EQ(anywhere, nearest_of_all(cover, p));
    EXPECT_TRUE(found == anywhere || found == -1);
    EXPECT_EQ(samples.find(p, from, looked_at) < 0, found < 0);
    if (found >= 0) continue;
    ++beyond;
    EXPECT_EQ(from, anywhere);
  }
  EXPECT_GT(beyond, 100);
  EXPECT_LT(beyond, 400);
}

// A point that goes through a solid or a cavity from side to side: the sample that was nearest before it came to the
// centre stays one whose normal goes through it.
TEST(NearestSample, IsAnotherOneBeyondACentre) {
  const Eigen::Vector3d center(3, -2, 5), z(0, 0, 1);
  const auto torus = make_torus(center, z, 24, 6, true);
  const auto ellipsoid = make_ellipsoid(center, Eigen::Matrix3d::Identity(), {20, 30, 35}, false);
  for (const Surface* surface : {torus.get(), ellipsoid.get()}) {
    const SurfaceCover cover(*surface, 1.5);
    NearestSample samples(cover);
    long looked_at = 0;
    for (int axis = 0; axis < 3; ++axis) {
      int from = -1;
      for (double x = -45; x <= 45; x += 0.7) {
        const Eigen::Vector3d p =
            center + x * Eigen::Vector3d::Unit(axis) + Eigen::Vector3d(0.01, 0.02, 0.03);
        const int found = samples.find(p, from, looked_at);
        const double nearest = (cover.sample(nearest_of_all(cover, p)).c - p).norm();
        EXPECT_LT((cover.sample(from).c - p).norm(), nearest / 0.95 + 1) << axis << " " << x;
        EXPECT_TRUE(found < 0 || found == from);
      }
    }
  }
}

// Of a ball and a cavity the radius inside, without end outside; of a torus that of its tube, and of its hole.
TEST(NearestSample, HoldsAsFarAsTheMedialAxis) {
  const Eigen::Vector3d z(0, 0, 1), origin(0, 0, 0);
  const auto reach_of = [](const Surface& surface, const Eigen::Vector3d& p, double side) {
    const SurfaceCover cover(surface, 1);
    NearestSample samples(cover);
    const int sample = nearest_of_all(cover, p);
    long looked_at = 0;
    double low = 0, high = 200;
    while (high - low > 0.01) {
      const double x = 0.5 * (low + high);
      (samples.holds(sample, side * x, looked_at) ? low : high) = x;
    }
    return low;
  };
  const auto ball = make_sphere(origin, 20, true), cavity = make_sphere(origin, 20, false);
  const auto torus = make_torus(origin, z, 24, 6, true);
  EXPECT_NEAR(reach_of(*ball, {20, 0, 0}, -1), 18, 0.5);
  EXPECT_GT(reach_of(*ball, {20, 0, 0}, 1), 100);
  EXPECT_NEAR(reach_of(*cavity, {20, 0, 0}, 1), 18, 0.5);
  EXPECT_NEAR(reach_of(*torus, {30, 0, 0}, -1), 0.9 * 6, 0.3);
  EXPECT_NEAR(reach_of(*torus, {18, 0, 0}, 1), 0.9 * 18, 0.5);
}

}  // namespace
}  // namespace condyle::test
