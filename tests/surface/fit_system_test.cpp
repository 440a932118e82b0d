#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "condyle/surface/banded_cholesky.h"
#include "condyle/surface/fit_smoothing.h"
#include "condyle/surface/fit_system.h"

namespace condyle {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// The same system, dense, by Eigen.
TEST(BandedCholesky, AgreesWithADenseFactorization) {
  constexpr int n = 23, band = 4;
  BandedMatrix banded(n, band);
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n, n);
  for (int i = 0; i < n; ++i)
    for (int j = std::max(0, i - band); j <= i; ++j) {
      const double value = i == j ? 9 + std::sin(i) : std::cos(3.0 * i + j);
      banded.at(i, j) = dense(i, j) = dense(j, i) = value;
    }
  const Eigen::MatrixXd right = Eigen::MatrixXd::Random(n, 3);
  Eigen::MatrixXd x = right;
  ASSERT_TRUE(banded.factorize());
  banded.solve(x);
  EXPECT_LT((x - dense.llt().solve(right)).norm(), 1e-12);
}

TEST(BandedCholesky, SaysWhenAMatrixIsNotPositiveDefinite) {
  BandedMatrix matrix(3, 1);
  matrix.at(0, 0) = matrix.at(2, 2) = 1;
  matrix.at(1, 1) = -1;
  EXPECT_FALSE(matrix.factorize());
}

SplineGrid grid_of(int degree, int cells, double side) {
  return {.degree = degree,
          .nu = cells + degree,
          .nv = cells + degree,
          .u_min = -side / 2,
          .u_max = side / 2,
          .v_min = -side / 2,
          .v_max = side / 2};
}
std::vector<CellMetric> plain_cells(const SplineGrid& grid) {
  return std::vector<CellMetric>(static_cast<std::size_t>(grid.cells_u()) * grid.cells_v());
}
double energy(const BandedMatrix& matrix, const std::vector<Vector3d>& x) {
  double sum = 0;
  for (int i = 0; i < matrix.size(); ++i)
    for (int j = std::max(0, i - matrix.band()); j <= i; ++j)
      sum += (i == j ? 1 : 2) * matrix.at(i, j) * x[i].dot(x[j]);
  return sum;
}

/// Control points of the spline that interpolates z = f(u, v), a cubic: a fit without smoothing
/// finds them.
std::vector<Vector3d> control_points_of(const SplineGrid& grid, double (*f)(double, double)) {
  std::vector<DataPoint> points;
  for (double u = grid.u_min + 0.05; u < grid.u_max; u += 0.5)
    for (double v = grid.v_min + 0.05; v < grid.v_max; v += 0.5)
      points.push_back({{u, v, f(u, v)}, {u, v}, 1});
  return solve_fit(assemble_data(grid, points), assemble_penalty(grid, plain_cells(grid)), 1e-3);
}

// z = u³/6 has z_uuu = 1 and no other third derivative: ∫|∇³c|² = area. z = u²v/2 has z_uuv = 1,
// which |∇³z|² counts three times. u and v themselves have no third derivatives.
TEST(FitPenalty, IntegratesThirdDerivativesExactly) {
  for (const int degree : {3, 4, 5}) {
    const SplineGrid grid = grid_of(degree, 5, 10);
    const PenaltyTerm penalty = assemble_penalty(grid, plain_cells(grid));
    EXPECT_NEAR(energy(penalty.third,
                       control_points_of(grid, [](double u, double) { return u * u * u / 6; })),
                100, 1e-6);
    EXPECT_NEAR(energy(penalty.third,
                       control_points_of(grid, [](double u, double v) { return u * u * v / 2; })),
                300, 1e-6);
    EXPECT_NEAR(energy(penalty.third,
                       control_points_of(grid, [](double u, double v) { return u * v - v * v; })),
                0, 1e-6);
  }
}

// z = uv has |∇²z|² = 2; only cells without data count.
TEST(FitPenalty, BendsNothingWhereThereAreNoData) {
  const SplineGrid grid = grid_of(3, 5, 10);
  std::vector<CellMetric> cells = plain_cells(grid);
  const std::vector<Vector3d> x = control_points_of(grid, [](double u, double v) { return u * v; });
  EXPECT_NEAR(energy(assemble_penalty(grid, cells).second_outside, x), 0, 1e-9);
  cells[7].known = false;
  EXPECT_NEAR(energy(assemble_penalty(grid, cells).second_outside, x), 2 * 4,
              1e-6);  // one cell of 2 x 2 mm
}

// A chart stretched by s in u measures arc length s u: the third derivative per mm falls by s³ and
// the area grows by s.
TEST(FitPenalty, MeasuresDerivativesPerMillimetreOfSurface) {
  const SplineGrid grid = grid_of(3, 5, 10);
  std::vector<CellMetric> cells = plain_cells(grid);
  for (CellMetric& cell : cells) cell.stretch_u = 2;
  const std::vector<Vector3d> x =
      control_points_of(grid, [](double u, double) { return u * u * u / 6; });
  EXPECT_NEAR(energy(assemble_penalty(grid, cells).third, x), 100.0 * 2 / 64, 1e-6);
}

/// Texture of unit rms with correlation exp(-d²/2l²), l = 1.5 mm: many plane waves, wave vectors
/// normally distributed with deviation 1/l.
double texture(double x, double y) {
  constexpr int kWaves = 300;
  constexpr double kCorrelation = 1.5;
  double sum = 0;
  for (int k = 0; k < kWaves; ++k) {
    const double radius = std::sqrt(-2 * std::log((k + 0.5) / kWaves)) / kCorrelation;  // Rayleigh
    const double angle = 2.399963 * k;  // golden angle
    sum += std::cos(radius * (x * std::cos(angle) + y * std::sin(angle)) + 1.7 * k * k);
  }
  return sum / std::sqrt(kWaves / 2.0);
}
double dish(double x, double y) {
  return x * x / 60 - y * y / 80 + 1.5 * std::cos(x / 7) * std::cos(y / 9);
}

Eigen::Vector2d dish_slope(double x, double y) {
  return {x / 30 - 1.5 / 7 * std::sin(x / 7) * std::cos(y / 9),
          -y / 40 - 1.5 / 9 * std::cos(x / 7) * std::sin(y / 9)};
}

struct Study {
  SplineGrid grid = grid_of(3, 14, 38);
  std::vector<DataPoint> points;
  PenaltyTerm penalty = assemble_penalty(grid, plain_cells(grid));

  explicit Study(double roughness) {
    for (double u = -18.9; u < 19; u += 0.8)
      for (double v = -18.9; v < 19; v += 0.8)
        points.push_back({{u, v, dish(u, v) + roughness * texture(u, v)}, {u, v}, 0.64});
  }
  /// rms distance from the true dish [mm], or of its slopes [rad], away from the edge.
  [[nodiscard]] double error(double smoothing_length,
                             SmoothingAim aim = SmoothingAim::kPositions) const {
    const Patch patch(
        patch_data(grid, solve_fit(assemble_data(grid, points), penalty, smoothing_length)));
    double sum = 0, count = 0;
    for (double u = -15; u < 15; u += 0.7)
      for (double v = -15; v < 15; v += 0.7) {
        const PatchDerivatives at = patch.derivatives(u, v);
        const double d = at.c.z() - dish(u, v);
        sum += aim == SmoothingAim::kPositions
                   ? d * d
                   : (Eigen::Vector2d(at.c_u.z(), at.c_v.z()) - dish_slope(u, v)).squaredNorm();
        ++count;
      }
    return std::sqrt(sum / count);
  }
  [[nodiscard]] SmoothingChoice choice(const SmoothingOptions& options = {}) const {
    return choose_smoothing(grid, points, std::vector<Judgement>(points.size()), penalty, options);
  }
};

// Against the best length of a scan made knowing the truth. Plain cross-validation would follow the
// texture.
TEST(FitSmoothing, IsCloseToTheBestChoiceOnTexture) {
  for (const double roughness : {0.1, 0.2, 0.3}) {
    const Study study(roughness);
    double best = 1e300;
    for (double length = 0.75; length < 6; length *= 1.15)
      best = std::min(best, study.error(length));
    const SmoothingChoice choice = study.choice({.aim = SmoothingAim::kPositions});
    EXPECT_LT(study.error(choice.length), 1.3 * best)
        << "roughness " << roughness << ", length " << choice.length;
    EXPECT_NEAR(choice.texture.rms, roughness, 0.5 * roughness);
  }
}

// Normals ask for more smoothing than positions do, and get it.
TEST(FitSmoothing, IsCloseToTheBestChoiceForNormalsOnTexture) {
  constexpr SmoothingAim kNormals = SmoothingAim::kNormals;
  for (const double roughness : {0.1, 0.2, 0.3}) {
    const Study study(roughness);
    double best = 1e300;
    for (double length = 0.75; length < 6; length *= 1.15)
      best = std::min(best, study.error(length, kNormals));
    const SmoothingChoice choice = study.choice();
    EXPECT_LT(study.error(choice.length, kNormals), 1.3 * best)
        << "roughness " << roughness << ", length " << choice.length;
    EXPECT_GT(choice.length, study.choice({.aim = SmoothingAim::kPositions}).length);
  }
}

// A thousandth of the points moved by a hundredth of a millimetre moves the choice by little: no
// explanation of the bands is taken and the next one dropped.
TEST(FitSmoothing, DoesNotJump) {
  Study study(0.2);
  const double before = study.choice().length;
  for (std::size_t i = 0; i < study.points.size(); i += 1000) study.points[i].p.z() += 0.01;
  EXPECT_NEAR(study.choice().length, before, 0.002 * before);
}

// Each by its own texture: below the least one that is taken for granted all are the same.
TEST(FitSmoothing, SmoothsRoughMeshesMore) {
  SmoothingOptions options;
  options.least_texture = {0.01, 1.5};
  EXPECT_GT(Study(0.3).choice(options).length, 1.1 * Study(0.05).choice(options).length);
}

}  // namespace
}  // namespace condyle
