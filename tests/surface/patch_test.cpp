#include "condyle/surface/patch.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "condyle/surface/bspline_basis.h"
#include "condyle/surface/patch_cells.h"
#include "support/numerical_jacobian.h"

namespace condyle {
namespace {

/// A wavy sheet over about 30 x 20 mm whose control points are no height field.
PatchData wavy_sheet(int degree_u, int degree_v) {
  PatchData data;
  data.degree = {degree_u, degree_v};
  data.nu = 12;
  data.nv = 9;
  data.knots_u = uniform_knots(data.nu, degree_u, 0, 30);
  data.knots_v = uniform_knots(data.nv, degree_v, -5, 15);
  for (int i = 0; i < data.nu; ++i)
    for (int j = 0; j < data.nv; ++j)
      data.control_points.emplace_back(3.1 * i + 0.4 * std::sin(2.0 * j),
                                       3.3 * j + 0.3 * std::cos(1.0 * i),
                                       2 * std::sin(0.6 * i) + 1.5 * std::cos(0.8 * j));
  return data;
}

class PatchOfDegree : public testing::TestWithParam<std::array<int, 2>> {};
INSTANTIATE_TEST_SUITE_P(Degrees,
                         PatchOfDegree,
                         testing::Values(std::array{3, 3}, std::array{3, 4}, std::array{5, 5}));

// Within the box and beyond it, where the patch goes on to second order.
TEST_P(PatchOfDegree, DerivativesMatchDifferences) {
  const Patch patch(wavy_sheet(GetParam()[0], GetParam()[1]));
  for (const Eigen::Vector2d& uv : {Eigen::Vector2d(7.3, 2.1), Eigen::Vector2d(29.2, -4.4),
                                    Eigen::Vector2d(32, 3.3), Eigen::Vector2d(-2, 17)}) {
    const auto at = [&](const Eigen::Vector2d& d) {
      return patch.derivatives(uv.x() + d.x(), uv.y() + d.y());
    };
    const PatchDerivatives d = at({0, 0});
    using Columns = Eigen::Matrix<double, 3, 2>;
    const Columns first =
        test::jacobian_at_zero<3, 2>([&](const Eigen::Vector2d& s) { return at(s).c; });
    const Columns of_u =
        test::jacobian_at_zero<3, 2>([&](const Eigen::Vector2d& s) { return at(s).c_u; });
    const Columns of_v =
        test::jacobian_at_zero<3, 2>([&](const Eigen::Vector2d& s) { return at(s).c_v; });
    EXPECT_LT((first.col(0) - d.c_u).norm() + (first.col(1) - d.c_v).norm(), 1e-9);
    EXPECT_LT((of_u.col(0) - d.c_uu).norm() + (of_u.col(1) - d.c_uv).norm(), 1e-9);
    EXPECT_LT((of_v.col(0) - d.c_uv).norm() + (of_v.col(1) - d.c_vv).norm(), 1e-9);
  }
}

// By knot cells as by basis functions: within a cell, on a knot, at the ends, beyond the box; knots
// evenly spaced or not.
TEST_P(PatchOfDegree, IsTheSameByItsCells) {
  PatchData uneven = wavy_sheet(GetParam()[0], GetParam()[1]);
  for (double& t : uneven.knots_u) t += t > 0 && t < 30 ? 0.4 * std::sin(t) : 0;
  for (const PatchData& data : {wavy_sheet(GetParam()[0], GetParam()[1]), uneven}) {
    const Patch patch(data);
    const PatchCells cells(patch);
    const double everywhere[] = {7.3, 0, 30, 31}, inside[] = {7.3, 0, 30, 12.9},
                 together[] = {7.3, 7.4, 7.35, 7.3}, v[] = {2.1, 2.2, 2.1, 2.15},
                 across[] = {2.1, 15, 0, 3};
    for (const auto& [u, w] :
         {std::pair(everywhere, across), std::pair(inside, across), std::pair(together, v)}) {
      FourDerivatives found;
      cells.derivatives(u, w, found);
      for (int k = 0; k < 4; ++k) {
        const PatchDerivatives d = patch.derivatives(u[k], w[k]);
        const Eigen::Vector3d* all[] = {&d.c, &d.c_u, &d.c_v, &d.c_uu, &d.c_uv, &d.c_vv};
        for (int i = 0; i < 6; ++i)
          for (int x = 0; x < 3; ++x)  // of some 40 mm to round-off
            EXPECT_NEAR(found.d[i][x][k], (*all[i])[x], 2e-13) << i << x << k;
      }
    }
  }
}

// What Newton's method is led to where a surface degenerates: it reads no memory beyond the net.
TEST_P(PatchOfDegree, APlaceThatIsNoNumberHasNoNumbers) {
  const PatchData data = wavy_sheet(GetParam()[0], GetParam()[1]);
  const Patch patch(data);
  const double no_number = std::nan("");
  for (const Place& at : {Patch::place(no_number, 3), Patch::place(3, no_number)})
    EXPECT_FALSE(patch.evaluate(at).c.allFinite());
  EXPECT_FALSE(patch.evaluate(Patch::place(1e300, -1e300)).c.allFinite());
  FourDerivatives found;
  const double u[] = {no_number, 3, 3, 3}, v[] = {3, no_number, 3, 3};
  PatchCells(patch).derivatives(u, v, found);
  for (int x = 0; x < 3; ++x)
    EXPECT_TRUE(std::isnan(found.d[0][x][0]) && std::isnan(found.d[0][x][1]) &&
                std::isfinite(found.d[0][x][2]));
}

// dn = -K dc and du = g_u.dc [Dortmans 1986, 2.18-2.44].
TEST_P(PatchOfDegree, CurvatureTensorTurnsTheNormal) {
  const Patch patch(wavy_sheet(GetParam()[0], GetParam()[1]));
  const double u = 11.7, v = 6.2;
  const SurfacePoint point = patch.evaluate(Patch::place(u, v));
  const PatchDerivatives d = patch.derivatives(u, v);
  const Eigen::Matrix<double, 3, 2> dn =
      test::jacobian_at_zero<3, 2>([&](const Eigen::Vector2d& s) {
        return patch.evaluate(Patch::place(u + s.x(), v + s.y())).n;
      });
  EXPECT_LT((dn.col(0) + point.K * d.c_u).norm() + (dn.col(1) + point.K * d.c_v).norm(), 1e-9);
  EXPECT_LT((point.K * point.n).norm(), 1e-14);
  EXPECT_NEAR(point.dual.col(0).dot(d.c_u), 1, 1e-13);
  EXPECT_NEAR(point.dual.col(0).dot(d.c_v), 0, 1e-13);
  EXPECT_NEAR(point.dual.col(1).dot(d.c_v), 1, 1e-13);
}

// The basis adds up to one and its derivatives to nothing; a uniform cubic has 1/6, 2/3, 1/6 at a
// knot.
TEST(BsplineBasis, IsAPartitionOfUnity) {
  const std::vector<double> knots = uniform_knots(8, 3, 0, 5);
  for (double t = 0; t <= 5; t += 0.37) {
    const BasisValues b = basis(knots, 3, t, 3);
    for (int k = 0; k <= 3; ++k) {
      double sum = 0;
      for (int j = 0; j <= 3; ++j)
        sum += b.d[static_cast<std::size_t>(k)][static_cast<std::size_t>(j)];
      EXPECT_NEAR(sum, k == 0 ? 1 : 0, 1e-12);
    }
  }
  const BasisValues at_knot = basis(knots, 3, 2, 0);
  EXPECT_NEAR(at_knot.d[0][0], 1.0 / 6, 1e-15);
  EXPECT_NEAR(at_knot.d[0][1], 2.0 / 3, 1e-15);
  EXPECT_NEAR(at_knot.d[0][2], 1.0 / 6, 1e-15);
}

TEST(Patch, CurvatureIsContinuousAcrossKnots) {
  const PatchData data = wavy_sheet(3, 3);
  const Patch patch(data);
  for (std::size_t i = 4; i + 4 < data.knots_u.size(); ++i) {
    const double u = data.knots_u[i];
    const Eigen::Matrix3d below = patch.evaluate(Patch::place(u - 1e-9, 4)).K,
                          above = patch.evaluate(Patch::place(u + 1e-9, 4)).K;
    EXPECT_LT((below - above).norm(), 1e-8);  // third derivatives of about 1 over 2e-9
  }
}

// The residual of the closest point is normal to the surface.
TEST(Patch, ClosestPointHasTheNormalThroughThePoint) {
  const Patch patch(wavy_sheet(3, 3));
  for (const Eigen::Vector3d& p :
       {Eigen::Vector3d(12, 9, 5), Eigen::Vector3d(20, 15, -3), Eigen::Vector3d(8, 20, 1)}) {
    const SurfacePoint closest = patch.evaluate(patch.closest(p, patch.seed(p)));
    EXPECT_LT(closest.n.cross(p - closest.c).norm(), 1e-10);
  }
}

TEST(Patch, MovedIsFirstOrderExact) {
  const Patch patch(wavy_sheet(3, 3));
  const Place place = Patch::place(10, 5);
  const SurfacePoint at = patch.evaluate(place);
  const Eigen::Vector3d t = at.n.unitOrthogonal();
  for (const double h : {1e-2, 1e-3}) {
    const Eigen::Vector3d reached = patch.evaluate(patch.moved(place, at, h * t)).c;
    EXPECT_LT((reached - at.c - h * t).norm(), h * h);  // curvatures below 1/mm
  }
}

}  // namespace
}  // namespace condyle
