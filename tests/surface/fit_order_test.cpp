/// How fast the error of a fit falls with the knot spacing on exact data: a spline of degree p is
/// of order p + 1 in position and p - 1 in curvature.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <memory>

#include "condyle/mesh/mesh_measures.h"
#include "condyle/surface/exact_surfaces.h"
#include "condyle/surface/fit_patch.h"
#include "support/mesh_shapes.h"

namespace condyle {
namespace {

/// A part of a closed surface as a height over the plane, and the surface itself.
struct Shape {
  const char* name;
  std::function<double(double, double)> height;
  std::shared_ptr<const Surface> exact;
};

/// As large as a condyle.
Shape ellipsoid() {
  const double a = 30, b = 22, c = 25;
  return {"ellipsoid",
          [=](double x, double y) { return c * std::sqrt(1 - x * x / (a * a) - y * y / (b * b)); },
          make_ellipsoid({0, 0, 0}, Eigen::Matrix3d::Identity(), {a, b, c}, true)};
}

/// Bent as a condyle is, one way by 18 mm and the other by 38 mm.
Shape torus() {
  const double major = 20, minor = 18;
  return {"torus",
          [=](double x, double y) {
            const double r = major + std::sqrt(minor * minor - y * y);
            return std::sqrt(r * r - x * x);
          },
          make_torus({0, 0, 0}, {0, 1, 0}, major, minor, true)};
}

ArticularRegion sheet(const Shape& shape) {
  ArticularRegion region;
  region.mesh = test::height_sheet(24, 96, shape.height);
  region.normals = vertex_normals(region.mesh);
  for (std::size_t i = 0; i < region.normals.size(); ++i) {
    region.chart.emplace_back(region.mesh.vertices[i].head<2>());
    region.slope.push_back(region.normals[i].z());
  }
  return region;
}

struct Errors {
  double position = 0, curvature = 0;  ///< rms away from the edge [mm], [1/mm]
};
Errors errors_of_fit(const Shape& shape, const ArticularRegion& region, int degree, int spans) {
  const int net = spans + degree;
  const Patch patch(fit_patch(region, {.control_points = {{net, net}},
                                       .smoothing_length = 0.02,
                                       .degree = degree,
                                       .rounds = 12,
                                       .settled = 1e-10})
                        .patch);
  Errors errors;
  int count = 0;
  for (double u = -8; u <= 8; u += 0.37)
    for (double v = -8; v <= 8; v += 0.41, ++count) {
      const SurfacePoint at = patch.evaluate(Patch::place(u, v));
      const SurfacePoint exact =
          shape.exact->evaluate(shape.exact->closest(at.c, shape.exact->seed(at.c)));
      errors.position += (at.c - exact.c).squaredNorm();
      errors.curvature += (at.K - exact.K).squaredNorm();
    }
  return {std::sqrt(errors.position / count), std::sqrt(errors.curvature / count)};
}

/// Between two numbers of spans over the 26 mm of the parameter box (24 and its margins).
struct Orders {
  double position, curvature;
};
Orders observed_orders(const Shape& shape, int degree, std::array<int, 2> spans) {
  const ArticularRegion region = sheet(shape);
  const Errors coarse = errors_of_fit(shape, region, degree, spans[0]),
               fine = errors_of_fit(shape, region, degree, spans[1]);
  const double step = std::log(static_cast<double>(spans[1]) / spans[0]);
  return {std::log(coarse.position / fine.position) / step,
          std::log(coarse.curvature / fine.curvature) / step};
}

// Spacings of 4.3 and 2.2 mm.
TEST(FitOrder, OfBicubicPatchesIsFourInPositionAndTwoInCurvature) {
  for (const Shape& shape : {ellipsoid(), torus()}) {
    const Orders orders = observed_orders(shape, 3, {6, 12});
    EXPECT_NEAR(orders.position, 4, 0.4) << shape.name;
    EXPECT_NEAR(orders.curvature, 2, 0.2) << shape.name;
  }
}

// The same spacings.
TEST(FitOrder, OfDegreeFiveIsSixInPositionAndFourInCurvature) {
  for (const Shape& shape : {ellipsoid(), torus()}) {
    const Orders orders = observed_orders(shape, 5, {6, 12});
    EXPECT_NEAR(orders.position, 6, 0.6) << shape.name;
    EXPECT_NEAR(orders.curvature, 4, 0.4) << shape.name;
  }
}

}  // namespace
}  // namespace condyle
