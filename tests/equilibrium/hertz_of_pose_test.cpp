#include <gtest/gtest.h>

#include "condyle/equilibrium/equilibrium_solver.h"
#include "condyle/math/rotation.h"
#include "condyle/surface/exact_surfaces.h"

namespace condyle {
namespace {

/// A soft ellipsoid with semi-axes 30, 20, 10 standing on its shortest one, everything turned by X.
PoseResult pose_of_pebble(const RigidTransform& X, bool elastic) {
  Model model;
  ContactPair pair;
  pair.name = "floor";
  pair.on_B = make_plane(X.p, X.R.col(2));
  pair.on_A = make_ellipsoid({0, 0, 0}, Eigen::Matrix3d::Identity(), {30, 20, 10}, true);
  if (elastic) pair.elastic_A = ElasticSurface{10, 0.45, 0};
  model.pairs = {pair};
  Load weight;
  weight.vector = X.R * Eigen::Vector3d(0, 0, -80);
  model.loads = {weight};
  model.load_names = {"weight"};
  for (int k = 0; k < 3; ++k) {  // a spring to each side keeps it from rolling and turning away
    LineElement& element = model.elements.emplace_back();
    element.x_C = X * Eigen::Vector3d(k == 0 ? 20 : -20, 5.0 * k, 10);
    element.s_D = {k == 0 ? 20.0 : -20.0, 5.0 * k, 0};
    element.x_C += X.R * Eigen::Vector3d(0, 0, 1);
    element.law = PolynomialLaw{{0, 0.5}, false};
    model.element_names.emplace_back("tether");
  }
  model.start = X * RigidTransform{exp_rotation({0.02, 0.01, 0.03}), {0.5, 0.4, 10.3}};
  model.length = 20;
  return EquilibriumSolver(model).solve();
}

// Curvatures 10/30² and 10/20² at the lowest point: the ellipse is long along the longest axis.
TEST(HertzOfPose, IsEstimatedForTheSolvedForce) {
  const RigidTransform X{exp_rotation({0.4, -0.8, 1.1}), {7, -3, 12}};
  const PoseResult pose = pose_of_pebble(X, true);
  ASSERT_TRUE(pose.converged()) << pose.reason;
  const ContactPointResult& point = pose.contacts[0].points[0];
  ASSERT_TRUE(point.hertz);
  const auto expected = elastic_contact(point.force, point.relative_curvature, std::nullopt,
                                        ElasticSurface{10, 0.45, 0});
  ASSERT_TRUE(expected);
  EXPECT_DOUBLE_EQ(point.hertz->semi_axes[0], expected->semi_major);
  EXPECT_DOUBLE_EQ(point.hertz->semi_axes[1], expected->semi_minor);
  EXPECT_DOUBLE_EQ(point.hertz->peak_pressure, expected->peak_pressure);
  EXPECT_DOUBLE_EQ(point.hertz->approach, expected->approach);
  EXPECT_GT(point.hertz->semi_axes[0], point.hertz->semi_axes[1]);
  EXPECT_NEAR(point.hertz->major_axis.dot(point.normal_ground), 0, 1e-12);
  EXPECT_NEAR(std::abs(point.hertz->major_axis.dot(pose.X_BA.R.col(0))), 1, 1e-2);
}

TEST(HertzOfPose, IsAbsentForRigidSurfaces) {
  const PoseResult pose = pose_of_pebble({}, false);
  ASSERT_TRUE(pose.converged()) << pose.reason;
  EXPECT_FALSE(pose.contacts[0].points[0].hertz);
}

}  // namespace
}  // namespace condyle
