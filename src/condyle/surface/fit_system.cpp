#include "condyle/surface/fit_system.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "condyle/input_error.h"
#include "condyle/math/decompositions.h"
#include "condyle/surface/bspline_basis.h"

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

namespace {

/// Sums of w x^i y^j (i, j <= 2p) and of w x^i y^j p (i, j <= p) over the points of one knot cell,
/// x and y from -1 to 1 within it: all that the normal equations want of the points.
struct CellMoments {
  static constexpr int kPowers = 2 * kMaxDegree + 1;
  double even[kPowers][kPowers];
  double right[kMost][kMost][4];
};

template <int kDegree>
void add_point(CellMoments& cell, double x, double y, const DataPoint& point) {
  double px[2 * kDegree + 1], py = point.weight;
  px[0] = 1;
  for (int i = 1; i <= 2 * kDegree; ++i) px[i] = px[i - 1] * x;
  const double p[4] = {point.p.x(), point.p.y(), point.p.z(), 0};
  for (int j = 0; j <= 2 * kDegree; ++j) {
    for (int i = 0; i <= 2 * kDegree; ++i) cell.even[j][i] += py * px[i];
    if (j <= kDegree)
      for (int i = 0; i <= kDegree; ++i)
        for (int c = 0; c < 4; ++c) cell.right[j][i][c] += py * px[i] * p[c];
    py *= y;
  }
}

/// Coefficients of the basis functions of a cell as polynomials in x from -1 to 1:
/// [function][power].
LocalMatrix cell_polynomials(int degree) {
  const std::vector<double> knots = uniform_knots(degree + 1, degree, -1, 1);
  Eigen::MatrixXd powers(degree + 1, degree + 1), values(degree + 1, degree + 1);
  for (int k = 0; k <= degree; ++k) {
    const double x = std::cos((k + 0.5) * M_PI / (degree + 1));
    const BasisValues b = basis(knots, degree, x, 0);
    for (int i = 0; i <= degree; ++i) powers(k, i) = std::pow(x, i), values(k, i) = b.d[0][i];
  }
  const Eigen::MatrixXd solved = fully_pivoted_solution(powers, values);
  LocalMatrix polynomials{};
  for (int a = 0; a <= degree; ++a)
    for (int i = 0; i <= degree; ++i) polynomials[a][i] = solved(i, a);
  return polynomials;
}

/// Products of two basis functions as polynomials: [pair][power].
std::vector<std::array<double, CellMoments::kPowers>> products(const LocalMatrix& f, int degree) {
  std::vector<std::array<double, CellMoments::kPowers>> result;
  for (int a = 0; a <= degree; ++a)
    for (int b = 0; b <= degree; ++b) {
      auto& product = result.emplace_back();
      for (int i = 0; i <= degree; ++i)
        for (int j = 0; j <= degree; ++j) product[i + j] += f[a][i] * f[b][j];
    }
  return result;
}

/// Adds one cell, whose first control point is (i0, j0), to the normal equations.
void add_moments(const CellMoments& cell,
                 const LocalMatrix& f,
                 const std::vector<std::array<double, CellMoments::kPowers>>& pairs,
                 const SplineGrid& grid,
                 int i0,
                 int j0,
                 DataTerm& term) {
  const int m = grid.degree + 1, powers = 2 * grid.degree + 1;
  for (int ab = 0; ab < m * m; ++ab) {
    if (ab % m > ab / m) continue;
    double along_v[CellMoments::kPowers] = {};
    for (int j = 0; j < powers; ++j)
      for (int i = 0; i < powers; ++i) along_v[j] += pairs[ab][i] * cell.even[j][i];
    for (int cd = 0; cd < m * m; ++cd) {
      const int row = (i0 + ab / m) * grid.nv + j0 + cd / m,
                column = (i0 + ab % m) * grid.nv + j0 + cd % m;
      if (column > row) continue;
      double sum = 0;
      for (int j = 0; j < powers; ++j) sum += pairs[cd][j] * along_v[j];
      term.matrix.at(row, column) += sum;
    }
  }
  for (int a = 0; a < m; ++a)
    for (int c = 0; c < m; ++c)
      for (int i = 0; i < m; ++i)
        for (int j = 0; j < m; ++j)
          for (int k = 0; k < 3; ++k)
            term.right((i0 + a) * grid.nv + j0 + c, k) += f[a][i] * f[c][j] * cell.right[j][i][k];
}

}  // namespace

DataTerm assemble_data(const SplineGrid& grid, const std::vector<DataPoint>& points) {
  DataTerm term{BandedMatrix(grid.size(), grid.band()), Eigen::MatrixXd::Zero(grid.size(), 3)};
  std::vector<CellMoments> cells(static_cast<std::size_t>(grid.cells_u()) * grid.cells_v());
  for (const DataPoint& point : points) {
    const double s = (point.uv.x() - grid.u_min) / grid.step_u(),
                 t = (point.uv.y() - grid.v_min) / grid.step_v();
    const int i = std::clamp(static_cast<int>(s), 0, grid.cells_u() - 1),
              j = std::clamp(static_cast<int>(t), 0, grid.cells_v() - 1);
    CellMoments& cell = cells[static_cast<std::size_t>(i) * grid.cells_v() + j];
    const double x = 2 * (s - i) - 1, y = 2 * (t - j) - 1;
    if (grid.degree == 3)
      add_point<3>(cell, x, y, point);
    else if (grid.degree == 4)
      add_point<4>(cell, x, y, point);
    else
      add_point<5>(cell, x, y, point);
  }
  const LocalMatrix f = cell_polynomials(grid.degree);
  const auto pairs = products(f, grid.degree);
  for (int i = 0; i < grid.cells_u(); ++i)
    for (int j = 0; j < grid.cells_v(); ++j) {
      const CellMoments& cell = cells[static_cast<std::size_t>(i) * grid.cells_v() + j];
      if (cell.even[0][0] > 0) add_moments(cell, f, pairs, grid, i, j, term);
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
      const double outside = area * std::pow(cell.bending, 4);
      if (!cell.known)
        add_cell<3>(term.second_outside, grid, i, j, gram_u, gram_v,
                    {outside * v2 * v2, 2 * outside * u2 * v2, outside * u2 * u2});
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
  if (!matrix.factorize()) throw InputError("the vertices do not determine the control points");
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
