#include "surface/fit_system.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "input_error.h"
#include "surface/bspline_basis.h"

namespace condyle {
namespace {

constexpr int kMost = kMaxDegree + 1;
using LocalMatrix = std::array<std::array<double, kMost>, kMost>;

/// Gram matrices ∫ B_a^(k) B_b^(k) dt over one knot cell of width `step`, k = 0 to 3; the same for
/// all cells.
std::array<LocalMatrix, 4> cell_grams(int degree, double step) {
  // Gauss points and weights on [0, 1], exact to degree 11.
  constexpr double kPoint[] = {0.0337652428984240, 0.1693953067668677, 0.3806904069584016};
  constexpr double kWeight[] = {0.0856622461895852, 0.1803807865240693, 0.2339569672863455};
  const std::vector<double> knots = uniform_knots(degree + 1, degree, 0, step);
  std::array<LocalMatrix, 4> grams{};
  for (int g = 0; g < 6; ++g) {
    const double t = g < 3 ? kPoint[g] : 1 - kPoint[g - 3];
    const double weight = kWeight[g % 3] * step;
    const BasisValues b = basis(knots, degree, t * step, 3);
    for (int k = 0; k < 4; ++k)
      for (int i = 0; i <= degree; ++i)
        for (int j = 0; j <= degree; ++j) grams[k][i][j] += weight * b.d[k][i] * b.d[k][j];
  }
  return grams;
}

/// Adds Σ_k factor[k] · gram_u[k] ⊗ gram_v[order - k] of one cell.
template <std::size_t N>
void add_cell(BandedMatrix& matrix,
              const SplineGrid& grid,
              int i0,
              int j0,
              const std::array<LocalMatrix, 4>& u,
              const std::array<LocalMatrix, 4>& v,
              const std::array<double, N>& factor) {
  constexpr int kOrder = static_cast<int>(N) - 1;
  const int m = grid.degree + 1;
  for (int a = 0; a < m; ++a)
    for (int b = 0; b <= a; ++b)
      for (int c = 0; c < m; ++c)
        for (int d = 0; d < m; ++d) {
          const int row = (i0 + a) * grid.nv + j0 + c, column = (i0 + b) * grid.nv + j0 + d;
          if (column > row) continue;
          double sum = 0;
          for (int k = 0; k <= kOrder; ++k) sum += factor[k] * u[k][a][b] * v[kOrder - k][c][d];
          matrix.at(row, column) += sum;
        }
}

}  // namespace

DataTerm assemble_data(const SplineGrid& grid, const std::vector<DataPoint>& points) {
  const int m = grid.degree + 1;
  const std::vector<double> knots_u = uniform_knots(grid.nu, grid.degree, grid.u_min, grid.u_max);
  const std::vector<double> knots_v = uniform_knots(grid.nv, grid.degree, grid.v_min, grid.v_max);
  DataTerm term{BandedMatrix(grid.size(), grid.band()), Eigen::MatrixXd::Zero(grid.size(), 3)};
  for (const DataPoint& point : points) {
    const BasisValues bu = basis(knots_u, grid.degree, point.uv.x(), 0);
    const BasisValues bv = basis(knots_v, grid.degree, point.uv.y(), 0);
    std::array<double, kMost * kMost> value;
    std::array<int, kMost * kMost> column;
    int count = 0;
    for (int a = 0; a < m; ++a)
      for (int c = 0; c < m; ++c) {
        value[count] = bu.d[0][a] * bv.d[0][c];
        column[count++] = (bu.first + a) * grid.nv + bv.first + c;
      }
    for (int i = 0; i < count; ++i) {
      const double weighted = point.weight * value[i];
      term.right.row(column[i]) += weighted * point.p.transpose();
      for (int j = 0; j <= i; ++j) term.matrix.at(column[i], column[j]) += weighted * value[j];
    }
  }
  return term;
}

PenaltyTerm assemble_penalty(const SplineGrid& grid, const std::vector<CellMetric>& cells) {
  const auto gram_u = cell_grams(grid.degree, grid.step_u()),
             gram_v = cell_grams(grid.degree, grid.step_v());
  PenaltyTerm term{BandedMatrix(grid.size(), grid.band()), BandedMatrix(grid.size(), grid.band())};
  for (int i = 0; i < grid.cells_u(); ++i)
    for (int j = 0; j < grid.cells_v(); ++j) {
      // ∂/∂s = (1/stretch) ∂/∂u along the surface; binomial factors of |∇^k c|².
      const CellMetric& cell = cells[static_cast<std::size_t>(i) * grid.cells_v() + j];
      const double u2 = 1 / (cell.stretch_u * cell.stretch_u),
                   v2 = 1 / (cell.stretch_v * cell.stretch_v);
      const double area = cell.stretch_u * cell.stretch_v;
      const double local = area * std::pow(cell.smoothing, 6);
      add_cell<4>(term.third, grid, i, j, gram_u, gram_v,
                  {local * v2 * v2 * v2, 3 * local * u2 * v2 * v2, 3 * local * u2 * u2 * v2,
                   local * u2 * u2 * u2});
      if (!cell.known)
        add_cell<3>(term.second_outside, grid, i, j, gram_u, gram_v,
                    {area * v2 * v2, 2 * area * u2 * v2, area * u2 * u2});
    }
  return term;
}

namespace {

BandedMatrix whole_matrix(const DataTerm& data,
                          const PenaltyTerm& penalty,
                          double smoothing_length) {
  const double l4 = std::pow(smoothing_length, 4), l6 = std::pow(smoothing_length, 6);
  return data.matrix.plus(l6, penalty.third).plus(l4, penalty.second_outside);
}

}  // namespace

std::vector<Eigen::Vector3d> solve_fit(const DataTerm& data,
                                       const PenaltyTerm& penalty,
                                       double smoothing_length) {
  BandedMatrix matrix = whole_matrix(data, penalty, smoothing_length);
  if (!matrix.factorize()) throw InputError("too few vertices to determine the control points");
  Eigen::MatrixXd x = data.right;
  matrix.solve(x);
  std::vector<Eigen::Vector3d> points(x.rows());
  for (Eigen::Index i = 0; i < x.rows(); ++i) points[i] = x.row(i).transpose();
  return points;
}

double fit_condition(const DataTerm& data, const PenaltyTerm& penalty, double smoothing_length) {
  const BandedMatrix matrix = whole_matrix(data, penalty, smoothing_length);
  BandedMatrix factor = matrix;
  if (!factor.factorize()) return std::numeric_limits<double>::infinity();
  return condition_number(matrix, factor);
}

PatchData patch_data(const SplineGrid& grid, std::vector<Eigen::Vector3d> control_points) {
  PatchData data;
  data.degree = {grid.degree, grid.degree};
  data.knots_u = uniform_knots(grid.nu, grid.degree, grid.u_min, grid.u_max);
  data.knots_v = uniform_knots(grid.nv, grid.degree, grid.v_min, grid.v_max);
  data.nu = grid.nu;
  data.nv = grid.nv;
  data.control_points = std::move(control_points);
  return data;
}

}  // namespace condyle
