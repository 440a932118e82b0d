#include "condyle/pictures/surface_shapes.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include "condyle/specimen/fit_surfaces.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

/// The square [0, 20] x [0, 20] of the plane z = 0. Control points at the averages of following
/// knots (Greville) make the chart the identity.
PatchData flat_patch(int orientation) {
  PatchData data;
  data.nu = data.nv = 8;
  for (int i = 0; i < 12; ++i) data.knots_u.push_back(4.0 * (i - 3));
  data.knots_v = data.knots_u;
  for (int i = 0; i < 8; ++i) {
    for (int j = 0; j < 8; ++j) data.control_points.emplace_back(4.0 * (i - 1), 4.0 * (j - 1), 0);
  }
  data.orientation = orientation;
  return data;
}

double area(const ShadedMesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3f p = mesh.vertices[a].position;
    sum += 0.5 * (mesh.vertices[b].position - p).cross(mesh.vertices[c].position - p).norm();
  }
  return sum;
}

TEST(PatchShape, CoversTheWholeBoxWithoutAMask) {
  EXPECT_NEAR(area(patch_shape(Patch(flat_patch(1)), {})), 400, 0.01);
}

TEST(PatchShape, IsCutOffAlongTheEdgeOfTheData) {
  PatchData data = flat_patch(1);
  // Known where u + v <= 20: the distance to the diagonal, linear within every cell up to its
  // bilinear part.
  data.mask_nu = data.mask_nv = 10;
  for (int i = 0; i <= 10; ++i) {
    for (int j = 0; j <= 10; ++j) data.mask.push_back((20 - 2.0 * i - 2.0 * j) / std::sqrt(2.0));
  }
  EXPECT_NEAR(area(patch_shape(Patch(data), {})), 200, 1) << "half of the square";
}

TEST(PatchShape, FacesOutOfTheBoneForEitherOrientation) {
  for (const int orientation : {1, -1}) {
    const ShadedMesh mesh = patch_shape(Patch(flat_patch(orientation)), {});
    ASSERT_FALSE(mesh.triangles.empty());
    for (const auto& [a, b, c] : mesh.triangles) {
      const Eigen::Vector3f p = mesh.vertices[a].position;
      const Eigen::Vector3f n =
          (mesh.vertices[b].position - p).cross(mesh.vertices[c].position - p);
      EXPECT_GT(n.z() * static_cast<float>(orientation), 0);
      EXPECT_NEAR(mesh.vertices[a].normal.z(), orientation, 1e-6);
    }
  }
}

TEST(ExactShape, PointsLieOnTheSurfacesTheyShow) {
  SurfaceDescription d;
  d.point = {1, 2, 3};
  d.direction = Vector3d(1, 2, 2) / 3;
  d.radius = 10;
  d.minor_radius = 3;
  for (const SurfaceKind kind :
       {SurfaceKind::kSphere, SurfaceKind::kCylinder, SurfaceKind::kTorus, SurfaceKind::kPlane}) {
    d.kind = kind;
    const ShadedMesh mesh = exact_shape(d, {}, {5, 5, 5});
    ASSERT_GT(mesh.vertices.size(), 100u);
    for (const ShadedVertex& vertex : mesh.vertices) {
      const Vector3d r = vertex.position.cast<double>() - d.point;
      const double along = r.dot(d.direction), across = (r - along * d.direction).norm();
      const double off = kind == SurfaceKind::kSphere     ? r.norm() - 10
                         : kind == SurfaceKind::kCylinder ? across - 10
                         : kind == SurfaceKind::kTorus    ? std::hypot(across - 10, along) - 3
                                                          : along;
      EXPECT_NEAR(off, 0, 1e-4) << "single precision";
    }
  }
}

TEST(ExactShape, APlaneWithARadiusIsDrawnWhereItIsKnown) {
  SurfaceDescription d;
  d.kind = SurfaceKind::kPlane;
  d.point = {1, 2, 3};
  d.known_radius = 7;
  double farthest = 0;
  for (const ShadedVertex& vertex : exact_shape(d, {}, {50, 50, 50}).vertices)
    farthest = std::max(farthest, (vertex.position.cast<double>() - d.point).norm());
  EXPECT_NEAR(farthest, 7, 1e-5);
}

TEST(ExactShape, ABoundedCylinderIsAsLongAsTheMechanicsKnowsIt) {
  SurfaceDescription d;
  d.kind = SurfaceKind::kCylinder;
  d.point = {1, 2, 3};
  d.direction = Vector3d(1, 2, 2) / 3;
  d.radius = 10;
  d.length = 30;
  const auto surface = make_exact_surface(d);
  double low = 0, high = 0;
  for (const ShadedVertex& vertex : exact_shape(d, {}, {50, 50, 50}).vertices) {
    const Vector3d p = vertex.position.cast<double>();
    low = std::min(low, d.direction.dot(p - d.point));
    high = std::max(high, d.direction.dot(p - d.point));
    EXPECT_GT(surface->edge_distance(surface->place_of(p)), -1e-4);
  }
  EXPECT_NEAR(low, -15, 1e-4);
  EXPECT_NEAR(high, 15, 1e-4);
}

}  // namespace
}  // namespace condyle
