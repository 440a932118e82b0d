/// How fast the error of a fit falls with the knot spacing on exact data: a spline of degree p is
/// of order p + 1 in position and p - 1 in curvature.

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "mesh/mesh_measures.h"
#include "mesh/mesh_shapes.h"
#include "surface/fit_patch.h"

namespace condyle {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

const Vector3d kAxes(30, 22, 25);  // of an ellipsoid as large as a condyle [mm]

double height(double x, double y) {
  const double a = x / kAxes.x(), b = y / kAxes.y();
  return kAxes.z() * std::sqrt(1 - a * a - b * b);
}

ArticularRegion cap_of_ellipsoid() {
  ArticularRegion region;
  region.mesh = testing::height_sheet(24, 96, height);
  region.normals = vertex_normals(region.mesh);
  for (std::size_t i = 0; i < region.normals.size(); ++i) {
    region.chart.emplace_back(region.mesh.vertices[i].head<2>());
    region.slope.push_back(region.normals[i].z());
  }
  return region;
}

/// With f = x^2/a^2 + y^2/b^2 + z^2/c^2 - 1: distance f / |grad f| near the surface, and from
/// n = grad f / |grad f| the curvature tensor K = -P (hess f) P / |grad f|, P = I - n n.
struct Exact {
  double distance;
  Matrix3d K;
};
Exact exact_at(const Vector3d& p) {
  const Vector3d weight = kAxes.array().square().inverse(), gradient = 2 * weight.cwiseProduct(p);
  const Vector3d n = gradient.normalized();
  const Matrix3d P = Matrix3d::Identity() - n * n.transpose();
  const Matrix3d hessian = (2 * weight).asDiagonal();
  return {(p.dot(weight.cwiseProduct(p)) - 1) / gradient.norm(),
          -P * hessian * P / gradient.norm()};
}

struct Errors {
  double position = 0, curvature = 0;  ///< rms away from the edge [mm], [1/mm]
};
Errors errors_of_fit(const ArticularRegion& region, int degree, int spans) {
  const int net = spans + degree;
  const Patch patch(fit_patch(region, {.control_points = {{net, net}},
                                       .smoothing_length = 0.02,
                                       .degree = degree,
                                       .rounds = 12,
                                       .settled = 1e-10})
                        .patch);
  Errors errors;
  int count = 0;
  for (double u = -6; u <= 6; u += 0.31)
    for (double v = -6; v <= 6; v += 0.37, ++count) {
      const SurfacePoint at = patch.evaluate({u, v, 0});
      const Exact exact = exact_at(at.c);
      errors.position += exact.distance * exact.distance;
      errors.curvature += (at.K - exact.K).squaredNorm();
    }
  return {std::sqrt(errors.position / count), std::sqrt(errors.curvature / count)};
}

/// Between two numbers of spans over the 26 mm of the parameter box (24 and its margins).
struct Orders {
  double position, curvature;
};
Orders observed_orders(int degree, std::array<int, 2> spans) {
  const ArticularRegion region = cap_of_ellipsoid();
  const Errors coarse = errors_of_fit(region, degree, spans[0]),
               fine = errors_of_fit(region, degree, spans[1]);
  const double step = std::log(static_cast<double>(spans[1]) / spans[0]);
  return {std::log(coarse.position / fine.position) / step,
          std::log(coarse.curvature / fine.curvature) / step};
}

// Spacings of 4.3 and 2.2 mm: 1.4e-4 and 8e-6 mm, 2.8e-4 and 7e-5 per mm.
TEST(FitOrder, OfBicubicPatchesIsFourInPositionAndTwoInCurvature) {
  const Orders orders = observed_orders(3, {6, 12});
  EXPECT_NEAR(orders.position, 4, 0.4);
  EXPECT_NEAR(orders.curvature, 2, 0.2);
}

// The same spacings: 3e-6 and 3e-8 mm, 5e-6 and 3e-7 per mm.
TEST(FitOrder, OfDegreeFiveIsSixInPositionAndFourInCurvature) {
  const Orders orders = observed_orders(5, {6, 12});
  EXPECT_NEAR(orders.position, 6, 0.6);
  EXPECT_NEAR(orders.curvature, 4, 0.4);
}

}  // namespace
}  // namespace condyle
