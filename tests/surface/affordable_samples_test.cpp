#include "condyle/surface/affordable_samples.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "condyle/surface/exact_surfaces.h"

namespace condyle {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// A radius of 20 m in place of 20 mm would take 3e8 samples.
TEST(AffordableSamples, AreFewOfSurfacesOfAnySize) {
  const Vector3d o = Vector3d::Zero(), z = Vector3d::UnitZ();
  std::vector<std::unique_ptr<Surface>> large;
  for (const double size : {2e3, 2e4, 1e9, 1e90}) {
    large.push_back(make_sphere(o, size, true));
    large.push_back(make_plane(o, z, size));
    large.push_back(make_cylinder(o, z, 20, true, size));
    large.push_back(make_cylinder(o, z, size, true, 20));
    large.push_back(make_torus(o, z, size, 10, true));
    large.push_back(make_ellipsoid(o, Matrix3d::Identity(), {20, 30, size}, true));
    large.push_back(make_polynomial(o, Matrix3d::Identity(), {{2, 0, 1e-3 / size}}, true, size));
  }
  for (const auto& surface : large) {
    const std::size_t n = affordable_samples(*surface, 2).size();
    EXPECT_GT(n, 30U) << surface->extent().radius;
    EXPECT_LT(n, 2U * kMostSamples) << surface->extent().radius;
  }
}

TEST(AffordableSamples, OfAKneeAreThoseThatAreWanted) {
  const auto ball = make_sphere(Vector3d::Zero(), 40, true);
  EXPECT_EQ(affordable_spacing(*ball, 2), 2);
  EXPECT_EQ(affordable_samples(*ball, 2), ball->samples(2));
  const auto plane = make_plane(Vector3d::Zero(), Vector3d::UnitZ());
  EXPECT_TRUE(affordable_samples(*plane, 2).empty());
}

}  // namespace
}  // namespace condyle
