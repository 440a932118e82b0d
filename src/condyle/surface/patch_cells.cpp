#include "condyle/surface/patch_cells.h"

#include <algorithm>
#include <cmath>

#include "condyle/math/simd.h"
#include "condyle/surface/bspline_basis.h"
#include "condyle/surface/knot_span.h"

namespace condyle {
namespace {

/// Basis functions on a span as polynomials from its lower end: [power][function].
struct SpanBasis {
  int first = 0;
  double c[4][4];

  SpanBasis(const std::vector<double>& knots, double from) {
    const BasisValues values = basis(knots, 3, from, 3);
    first = values.first;
    constexpr double kFactorial[] = {1, 1, 2, 6};
    for (int k = 0; k < 4; ++k)
      for (int j = 0; j < 4; ++j) c[k][j] = values.d[k][j] / kFactorial[k];
  }
};

/// Of one place: c, c_u, c_v, c_uu, c_uv, c_vv, by Horner's scheme with its derivatives.
inline __attribute__((always_inline)) void horner(const double* a, double x, double y, Four* out) {
  Four f[4], g[4], h[4];  // of each power of u: value, first and half the second derivative by v
  CONDYLE_UNROLL
  for (int k = 0; k < 4; ++k, a += 16) {
    const Four a3 = load_four(a + 12);
    f[k] = a3 * y + load_four(a + 8);
    g[k] = a3 * y + f[k];
    h[k] = a3 * y + g[k];
    f[k] = f[k] * y + load_four(a + 4);
    g[k] = g[k] * y + f[k];
    f[k] = f[k] * y + load_four(a);
  }
  Four c = f[3] * x + f[2], c_u = f[3] * x + c, c_uu = f[3] * x + c_u;
  c = c * x + f[1];
  c_u = c_u * x + c;
  Four c_v = g[3] * x + g[2], c_uv = g[3] * x + c_v;
  c_v = c_v * x + g[1];
  out[0] = c * x + f[0];
  out[1] = c_u;
  out[2] = c_v * x + g[0];
  out[3] = 2 * c_uu;
  out[4] = c_uv * x + c_v;
  out[5] = 2 * (((h[3] * x + h[2]) * x + h[1]) * x + h[0]);
}

/// Four places in one cell, by the same scheme.
inline __attribute__((always_inline)) void evaluate_together(const double* cell,
                                                             const Four& x,
                                                             const Four& y,
                                                             double (*out)[3][4]) {
  CONDYLE_UNROLL
  for (int c = 0; c < 3; ++c) {
    const double* a = cell + c;
    Four f[4], g[4], h[4];
    CONDYLE_UNROLL
    for (int k = 0; k < 4; ++k, a += 16) {
      f[k] = a[12] * y + a[8];
      g[k] = a[12] * y + f[k];
      h[k] = a[12] * y + g[k];
      f[k] = f[k] * y + a[4];
      g[k] = g[k] * y + f[k];
      f[k] = f[k] * y + a[0];
    }
    Four p = f[3] * x + f[2], p_u = f[3] * x + p, p_uu = f[3] * x + p_u;
    p = p * x + f[1];
    p_u = p_u * x + p;
    Four p_v = g[3] * x + g[2], p_uv = g[3] * x + p_v;
    p_v = p_v * x + g[1];
    store_four(out[0][c], p * x + f[0]);
    store_four(out[1][c], p_u);
    store_four(out[2][c], p_v * x + g[0]);
    store_four(out[3][c], 2 * p_uu);
    store_four(out[4][c], p_uv * x + p_v);
    store_four(out[5][c], 2 * (((h[3] * x + h[2]) * x + h[1]) * x + h[0]));
  }
}

/// Four places, each in a cell of its own.
inline __attribute__((always_inline)) void evaluate_inline(const double* const* cells,
                                                           const Four& x,
                                                           const Four& y,
                                                           double (*out)[3][4]) {
  Four at[4][6];
  CONDYLE_UNROLL
  for (int k = 0; k < 4; ++k) horner(cells[k], x[k], y[k], at[k]);
  CONDYLE_UNROLL
  for (int i = 0; i < 6; ++i) {
    const Four x_z = __builtin_shufflevector(at[0][i], at[1][i], 0, 4, 2, 6),
               y_0 = __builtin_shufflevector(at[0][i], at[1][i], 1, 5, 3, 7),
               X_Z = __builtin_shufflevector(at[2][i], at[3][i], 0, 4, 2, 6),
               Y_0 = __builtin_shufflevector(at[2][i], at[3][i], 1, 5, 3, 7);
    store_four(out[i][0], __builtin_shufflevector(x_z, X_Z, 0, 1, 4, 5));
    store_four(out[i][1], __builtin_shufflevector(y_0, Y_0, 0, 1, 4, 5));
    store_four(out[i][2], __builtin_shufflevector(x_z, X_Z, 2, 3, 6, 7));
  }
}

CONDYLE_FMA_CLONE
void evaluate(const double* const* cells, const double* x, const double* y, double (*out)[3][4]) {
  evaluate_inline(cells, load_four(x), load_four(y), out);
}

/// Knots as far from each other as 1/inverse_step.
struct UniformKnots {
  double min, max, inverse_step;
  const double* breaks;
  int spans;
};

using FourInts = int __attribute__((vector_size(16)));

/// The spans of four parameters.
inline __attribute__((always_inline)) FourInts spans_of(const UniformKnots& knots, const Four& t) {
  const int last = knots.spans - 1;
  const FourInts all = __builtin_convertvector((t - knots.min) * knots.inverse_step, FourInts),
                 lasts = {last, last, last, last};
  return all < lasts ? all : lasts;
}

inline __attribute__((always_inline)) Four within_spans(const UniformKnots& knots,
                                                        const FourInts& spans,
                                                        const Four& t) {
  return t - Four{knots.breaks[spans[0]], knots.breaks[spans[1]], knots.breaks[spans[2]],
                  knots.breaks[spans[3]]};
}

/// Four places; false where one lies beyond the box of parameters.
CONDYLE_FMA_CLONE
bool evaluate_uniform(const UniformKnots& knots_u,
                      const UniformKnots& knots_v,
                      const double* cells,
                      const double* u,
                      const double* v,
                      double (*out)[3][4]) {
  constexpr std::ptrdiff_t kNumbers = 64;  // of a cell
  const Four at_u = load_four(u), at_v = load_four(v);
  const auto inside =
      (at_u >= knots_u.min) & (at_u <= knots_u.max) & (at_v >= knots_v.min) & (at_v <= knots_v.max);
  if ((inside[0] & inside[1] & inside[2] & inside[3]) == 0) return false;
  const FourInts i = spans_of(knots_u, at_u), j = spans_of(knots_v, at_v),
                 index = i * knots_v.spans + j;
  const double* const own[] = {cells + kNumbers * index[0], cells + kNumbers * index[1],
                               cells + kNumbers * index[2], cells + kNumbers * index[3]};
  if (index[0] == index[1] && index[0] == index[2] && index[0] == index[3])
    evaluate_together(own[0], within_spans(knots_u, i, at_u), within_spans(knots_v, j, at_v), out);
  else
    evaluate_inline(own, within_spans(knots_u, i, at_u), within_spans(knots_v, j, at_v), out);
  return true;
}

}  // namespace

PatchCells::PatchCells(const Patch& patch) : patch_(patch) {
  const PatchData& data = patch.data();
  if (data.degree != std::array<int, 2>{3, 3}) return;
  const auto direction = [](const std::vector<double>& knots, double min, double max) {
    Direction all;
    all.min = min;
    all.max = max;
    for (const double t : knots)
      if (t >= min && t <= max && (all.breaks.empty() || t > all.breaks.back()))
        all.breaks.push_back(t);
    const auto spans = static_cast<double>(all.breaks.size() - 1);
    const double step = (max - min) / spans;
    bool uniform = true;
    for (std::size_t s = 0; s < all.breaks.size(); ++s)
      uniform &= std::abs(all.breaks[s] - min - static_cast<double>(s) * step) < 1e-12 * step;
    all.inverse_step = uniform ? 1 / step : 0;
    return all;
  };
  u_ = direction(data.knots_u, patch.u_min(), patch.u_max());
  v_ = direction(data.knots_v, patch.v_min(), patch.v_max());
  for (std::size_t i = 0; i + 1 < u_.breaks.size(); ++i)
    for (std::size_t j = 0; j + 1 < v_.breaks.size(); ++j) {
      const SpanBasis of_u(data.knots_u, u_.breaks[i]), of_v(data.knots_v, v_.breaks[j]);
      Cell cell{};
      for (int k = 0; k < 4; ++k)
        for (int l = 0; l < 4; ++l)
          for (int m = 0; m < 16; ++m) {
            const Eigen::Vector3d& p =
                data.control_points[static_cast<std::size_t>(of_u.first + m / 4) * data.nv +
                                    of_v.first + m % 4];
            for (int x = 0; x < 3; ++x)
              cell.a[k][l][x] += of_u.c[k][m / 4] * of_v.c[l][m % 4] * p[x];
          }
      cells_.push_back(cell);
    }
}

std::array<int, 2> PatchCells::cell_of(double u, double v) const {
  const bool inside = !cells_.empty() && u >= u_.min && u <= u_.max && v >= v_.min && v <= v_.max;
  if (!inside) return {-1, -1};
  return {knot_span(u_.breaks, u_.inverse_step, u), knot_span(v_.breaks, v_.inverse_step, v)};
}

void PatchCells::derivatives_of_patch(double u, double v, int place, FourDerivatives& out) const {
  const PatchDerivatives d = patch_.derivatives(u, v);
  const Eigen::Vector3d* all[] = {&d.c, &d.c_u, &d.c_v, &d.c_uu, &d.c_uv, &d.c_vv};
  for (int i = 0; i < 6; ++i)
    for (int x = 0; x < 3; ++x) out.d[i][x][place] = (*all[i])[x];
}

void PatchCells::derivatives(const double* u, const double* v, FourDerivatives& out) const {
  const auto [nu, nv] = counts();
  if (u_.inverse_step > 0 && v_.inverse_step > 0 &&
      evaluate_uniform({u_.min, u_.max, u_.inverse_step, u_.breaks.data(), nu},
                       {v_.min, v_.max, v_.inverse_step, v_.breaks.data(), nv}, cells_[0].a[0][0],
                       u, v, out.d))
    return;
  const double* cells[4];
  double x[4], y[4];
  bool inside[4];
  for (int k = 0; k < 4; ++k) {
    const auto [i, j] = cell_of(u[k], v[k]);
    inside[k] = i >= 0;
    if (cells_.empty()) continue;
    cells[k] = cell(std::max(i, 0), std::max(j, 0)).a[0][0];
    x[k] = inside[k] ? u[k] - u_.breaks[i] : 0;
    y[k] = inside[k] ? v[k] - v_.breaks[j] : 0;
  }
  if (!cells_.empty()) evaluate(cells, x, y, out.d);
  for (int k = 0; k < 4; ++k)
    if (!inside[k]) derivatives_of_patch(u[k], v[k], k, out);
}

}  // namespace condyle
