#include "condyle/network/mass_properties.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "condyle/input_error.h"
#include "condyle/math/rotation.h"
#include "support/mesh_shapes.h"
#include "support/random.h"

namespace condyle {
namespace {

constexpr double kDensity = 1.9e-9;  // [tonne/mm³]

/// A cube with its corners pulled about, far from the origin: no symmetry left.
TriangleMesh irregular_solid() {
  test::Random random(3);
  TriangleMesh mesh = test::cube(40, {20, -10, 70});
  for (Eigen::Vector3d& p : mesh.vertices) p += random.vector(8);
  return mesh;
}

// A box a x b x c has J = m/12 diag(b² + c², ...) about its centre.
TEST(MassProperties, BoxHasItsTextbookInertia) {
  TriangleMesh mesh = test::cube(1, {-0.5, -0.5, -0.5});
  const Eigen::Vector3d sides(30, 50, 80), center(5, 6, 7);
  for (Eigen::Vector3d& p : mesh.vertices) p = p.cwiseProduct(sides) + center;
  const MassProperties box = mass_of_solid(mesh, kDensity, "box");
  const double m = kDensity * sides.prod();
  EXPECT_NEAR(box.mass, m, 1e-14 * m);
  EXPECT_LT((box.center - center).norm(), 1e-12);
  const Eigen::Vector3d s = sides.cwiseAbs2();
  const Eigen::Vector3d J = m / 12 * (s.sum() * Eigen::Vector3d::Ones() - s);
  EXPECT_LT((box.inertia - Eigen::Matrix3d(J.asDiagonal())).norm(), 1e-13 * J.norm());
}

// Turned and moved, a body keeps its mass and takes its centre and inertia along.
TEST(MassProperties, IntegralsMoveWithTheMesh) {
  test::Random random(5);
  TriangleMesh mesh = irregular_solid();
  const MassProperties before = mass_of_solid(mesh, kDensity, "solid");
  const RigidTransform X = random.pose(200);
  for (Eigen::Vector3d& p : mesh.vertices) p = X * p;
  const MassProperties after = mass_of_solid(mesh, kDensity, "solid");
  EXPECT_NEAR(after.mass, before.mass, 1e-13 * before.mass);
  EXPECT_LT((after.center - X * before.center).norm(), 1e-11);
  EXPECT_LT((after.inertia - X.R * before.inertia * X.R.transpose()).norm(),
            1e-12 * before.inertia.norm());
}

// Mass, ∫ R dm and J_0 about any point are those of the solid's volume integrals.
TEST(MassProperties, SixMassesAreEquimomentalToAnIrregularSolid) {
  test::Random random(9);
  const MassProperties solid = mass_of_solid(irregular_solid(), kDensity, "solid");
  const auto six = equimomental_points(solid);
  const MassProperties points = mass_of_points({six.begin(), six.end()});
  EXPECT_NEAR(points.mass, solid.mass, 1e-14 * solid.mass);
  for (int i = 0; i < 5; ++i) {
    const Eigen::Vector3d at = random.vector(100);
    EXPECT_LT((points.center - solid.center).norm(), 1e-11);
    const Eigen::Matrix3d J = inertia_about(solid, at);
    EXPECT_LT((inertia_about(points, at) - J).norm(), 1e-12 * J.norm());
    double polar = 0;  // ∫ r² dm
    for (const PointMass& p : six) polar += p.mass * (p.position - at).squaredNorm();
    EXPECT_NEAR(polar_inertia_about(solid, at), polar, 1e-12 * polar);
  }
}

TEST(MassProperties, AnOpenMeshHasNoMass) {
  TriangleMesh mesh = irregular_solid();
  mesh.triangles.pop_back();
  try {
    (void)mass_of_solid(mesh, kDensity, "body \"tibia\"");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "body \"tibia\": 3 edges of the mesh are not shared by two triangles that agree, "
                 "expected a closed mesh for its mass (or mass, center and inertia)");
  }
}

}  // namespace
}  // namespace condyle
