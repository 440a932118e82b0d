#include "condyle/surface/patch.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "condyle/math/decompositions.h"
#include "condyle/math/simd.h"
#include "condyle/mesh/point_tree.h"
#include "condyle/surface/bspline_basis.h"
#include "condyle/surface/knot_span.h"

namespace condyle {

/// Basis functions of one direction and two derivatives.
struct Patch::Basis {
  alignas(16) double b[3][kMaxDegree + 1];
};

/// A coarse cloud of points of the patch, to find where a search for the closest point starts.
struct Patch::SeedIndex {
  std::vector<Place> places;
  std::vector<Eigen::Vector3d> points;
  PointCloud cloud{points};
  std::unique_ptr<PointTree> tree;
};

namespace {

Eigen::Vector3d mean_of(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

}  // namespace

Patch::Patch(PatchData data)
    : data_(std::move(data)),
      u_(make_direction(data_.knots_u, data_.degree[0])),
      v_(make_direction(data_.knots_v, data_.degree[1])) {
  assert(static_cast<int>(data_.control_points.size()) == data_.nu * data_.nv);
  assert(u_.spans == data_.nu - data_.degree[0] && v_.spans == data_.nv - data_.degree[1]);
  net_.reserve(data_.control_points.size());
  for (const Eigen::Vector3d& p : data_.control_points) net_.emplace_back(p.x(), p.y(), p.z(), 0);
  const Eigen::Vector3d middle = mean_of(data_.control_points);
  for (const Eigen::Vector3d& p : data_.control_points)
    size_ = std::max(size_, 2 * (p - middle).norm());

  auto seeds = std::make_shared<SeedIndex>();
  const int nu = std::clamp(2 * u_.spans, 4, 60), nv = std::clamp(2 * v_.spans, 4, 60);
  for (int i = 0; i <= nu; ++i)
    for (int j = 0; j <= nv; ++j) {
      const double u = u_.min + (u_.max - u_.min) * i / nu, v = v_.min + (v_.max - v_.min) * j / nv;
      if (edge_distance(place(u, v)) < -3) continue;
      seeds->places.push_back(place(u, v));
      seeds->points.push_back(derivatives(u, v).c);
    }
  if (seeds->places.empty()) {
    const double u = (u_.min + u_.max) / 2, v = (v_.min + v_.max) / 2;
    seeds->places.push_back(place(u, v));
    seeds->points.push_back(derivatives(u, v).c);
  }
  seeds->tree = std::make_unique<PointTree>(3, seeds->cloud);
  extent_ = extent_of(seeds->places, seeds->points);
  seeds_ = std::move(seeds);
}

/// Of the seeds that lie within the known part, or of all where none does.
Extent Patch::extent_of(const std::vector<Place>& places,
                        const std::vector<Eigen::Vector3d>& points) const {
  std::vector<Eigen::Vector3d> known;
  for (std::size_t i = 0; i < places.size(); ++i)
    if (edge_distance(places[i]) >= 0) known.push_back(points[i]);
  if (known.empty()) known = points;
  const Eigen::Vector3d center = mean_of(known);
  double square = 0;
  for (const Eigen::Vector3d& p : known) square += (p - center).squaredNorm();
  return {center, std::sqrt(square / static_cast<double>(known.size()))};
}

std::unique_ptr<Surface> Patch::translated(const Eigen::Vector3d& d) const {
  auto copy = std::make_unique<Patch>(*this);
  for (Eigen::Vector3d& p : copy->data_.control_points) p += d;
  for (Eigen::Vector4d& p : copy->net_) p.head<3>() += d;
  copy->extent_.center += d;
  copy->seeds_moved_ += d;
  return copy;
}

Patch::Direction Patch::make_direction(const std::vector<double>& knots, int degree) {
  Direction direction;
  const int n = static_cast<int>(knots.size()) - degree - 1;
  direction.degree = degree;
  direction.spans = n - degree;
  assert(degree >= 2 && degree <= kMaxDegree && direction.spans >= 1);
  direction.breaks.assign(knots.begin() + degree, knots.begin() + n + 1);
  direction.min = direction.breaks.front();
  direction.max = direction.breaks.back();
  const double step = (direction.max - direction.min) / direction.spans;
  bool uniform = true;
  for (int s = 0; s <= direction.spans; ++s)
    uniform &= std::abs(direction.breaks[s] - direction.min - s * step) <
               1e-12 * (1 + std::abs(direction.max));
  direction.inverse_step = uniform ? 1 / step : 0;

  // On each span the basis functions are polynomials: interpolate them at degree + 1 points of the
  // span.
  const int m = degree + 1;
  direction.coefficients.assign(static_cast<std::size_t>(direction.spans) * m * m, 0);
  for (int s = 0; s < direction.spans; ++s) {
    const double width = direction.breaks[s + 1] - direction.breaks[s];
    if (width <= 0) continue;
    Eigen::MatrixXd powers(m, m), values(m, m);
    for (int k = 0; k < m; ++k) {
      const double x = (k + 0.5) / m;  // inside the span, in units of its width
      for (int j = 0; j < m; ++j) powers(k, j) = std::pow(x, j);
      const BasisValues b = basis(knots, degree, direction.breaks[s] + x * width, 0);
      for (int j = 0; j < m; ++j) values(k, j) = b.d[0][j];
    }
    const Eigen::MatrixXd polynomial = fully_pivoted_solution(powers, values);
    for (int k = 0; k < m; ++k)
      for (int j = 0; j < m; ++j)
        direction.coefficients[(static_cast<std::size_t>(s) * m + k) * m + j] =
            polynomial(k, j) / std::pow(width, k);
  }
  return direction;
}

namespace {

/// The bicubic case in one go: basis functions of both directions from their polynomials (16
/// coefficients each, at x and y within the span, continued by `beyond`), then the 16 control
/// points of `net`, whose rows are `stride` apart. Writes c, c_u, c_v and, where `second`, c_uu,
/// c_uv, c_vv; four numbers each.
CONDYLE_FMA_CLONE
void bicubic(const double* coefficients_u,
             double x,
             double beyond_u,
             const double* coefficients_v,
             double y,
             double beyond_v,
             const double* net,
             std::size_t stride,
             bool second,
             double* out) {
  double bu[3][4], bv[3][4];
  const auto basis = [](const double* c, double t, double beyond, double(*b)[4]) {
    Four c0, c1, c2, c3;
    __builtin_memcpy(&c0, c, sizeof c0);
    __builtin_memcpy(&c1, c + 4, sizeof c1);
    __builtin_memcpy(&c2, c + 8, sizeof c2);
    __builtin_memcpy(&c3, c + 12, sizeof c3);
    Four f = ((c3 * t + c2) * t + c1) * t + c0;
    Four df = (3 * c3 * t + 2 * c2) * t + c1;
    const Four d2f = 6 * c3 * t + 2 * c2;
    f += beyond * (df + beyond / 2 * d2f);
    df += beyond * d2f;
    __builtin_memcpy(b[0], &f, sizeof f);
    __builtin_memcpy(b[1], &df, sizeof df);
    __builtin_memcpy(b[2], &d2f, sizeof d2f);
  };
  basis(coefficients_u, x, beyond_u, bu);
  basis(coefficients_v, y, beyond_v, bv);
  Four c = {}, c_u = {}, c_v = {}, c_uu = {}, c_uv = {}, c_vv = {};
  for (int i = 0; i < 4; ++i, net += stride) {
    Four s0 = {}, s1 = {}, s2 = {};
    for (int j = 0; j < 4; ++j) {
      Four p;
      __builtin_memcpy(&p, net + std::ptrdiff_t{4} * j, sizeof p);
      s0 += bv[0][j] * p;
      s1 += bv[1][j] * p;
      if (second) s2 += bv[2][j] * p;
    }
    c += bu[0][i] * s0;
    c_u += bu[1][i] * s0;
    c_v += bu[0][i] * s1;
    if (!second) continue;
    c_uu += bu[2][i] * s0;
    c_uv += bu[1][i] * s1;
    c_vv += bu[0][i] * s2;
  }
  const Four* results[] = {&c, &c_u, &c_v, &c_uu, &c_uv, &c_vv};
  for (const Four* result : results) {
    __builtin_memcpy(out, result, sizeof *result);
    out += 4;
  }
}

/// Σ c[k] x^k with two derivatives for m basis functions of any degree (Horner).
void horner(const double* c, int m, double x, double* f, double* df, double* d2f) {
  for (int j = 0; j < m; ++j) f[j] = c[(m - 1) * m + j], df[j] = 0, d2f[j] = 0;
  for (int k = m - 2; k >= 0; --k)
    for (int j = 0; j < m; ++j) {
      d2f[j] = d2f[j] * x + df[j];
      df[j] = df[j] * x + f[j];
      f[j] = f[j] * x + c[k * m + j];
    }
  for (int j = 0; j < m; ++j) d2f[j] *= 2;
}

}  // namespace

int Patch::evaluate_direction(const Direction& direction, double t, Basis& basis) {
  const double inside = std::clamp(t, direction.min, direction.max);
  const int span = knot_span(direction.breaks, direction.inverse_step, inside);
  const int m = direction.degree + 1;
  const double x = inside - direction.breaks[span];
  const double* c = &direction.coefficients[static_cast<std::size_t>(span) * m * m];
  // cppcheck-suppress uninitvar ; here it is written
  horner(c, m, x, basis.b[0], basis.b[1], basis.b[2]);
  if (t != inside) {
    const double beyond = t - inside;
    for (int j = 0; j < m; ++j) {
      basis.b[0][j] += beyond * (basis.b[1][j] + beyond / 2 * basis.b[2][j]);
      basis.b[1][j] += beyond * basis.b[2][j];
    }
  }
  return span;
}

PatchDerivatives Patch::bicubic_derivatives(double u, double v, bool second) const {
  const double inside_u = std::clamp(u, u_.min, u_.max), inside_v = std::clamp(v, v_.min, v_.max);
  const int i = knot_span(u_.breaks, u_.inverse_step, inside_u),
            j = knot_span(v_.breaks, v_.inverse_step, inside_v);
  double out[24];
  bicubic(&u_.coefficients[static_cast<std::size_t>(i) * 16], inside_u - u_.breaks[i], u - inside_u,
          &v_.coefficients[static_cast<std::size_t>(j) * 16], inside_v - v_.breaks[j], v - inside_v,
          net_[static_cast<std::size_t>(i) * data_.nv + j].data(),
          4 * static_cast<std::size_t>(data_.nv), second, out);
  const auto vector = [&](int k) {
    const double* at = out + std::ptrdiff_t{4} * k;
    return Eigen::Vector3d(at[0], at[1], at[2]);
  };
  return {vector(0), vector(1), vector(2), vector(3), vector(4), vector(5)};
}

PatchDerivatives Patch::general_derivatives(double u, double v) const {
  Basis bu, bv;
  const int i0 = evaluate_direction(u_, u, bu);
  const int j0 = evaluate_direction(v_, v, bv);
  PatchDerivatives d;
  d.c.setZero();
  d.c_u = d.c_v = d.c_uu = d.c_uv = d.c_vv = d.c;
  for (int i = 0; i <= u_.degree; ++i)
    for (int j = 0; j <= v_.degree; ++j) {
      const Eigen::Vector3d& p =
          data_.control_points[static_cast<std::size_t>(i0 + i) * data_.nv + j0 + j];
      d.c += bu.b[0][i] * bv.b[0][j] * p;
      d.c_u += bu.b[1][i] * bv.b[0][j] * p;
      d.c_v += bu.b[0][i] * bv.b[1][j] * p;
      d.c_uu += bu.b[2][i] * bv.b[0][j] * p;
      d.c_uv += bu.b[1][i] * bv.b[1][j] * p;
      d.c_vv += bu.b[0][i] * bv.b[2][j] * p;
    }
  return d;
}

PatchDerivatives Patch::derivatives(double u, double v) const {
  return u_.degree == 3 && v_.degree == 3 ? bicubic_derivatives(u, v, true)
                                          : general_derivatives(u, v);
}

SurfacePoint Patch::evaluate(const Place& at) const {
  return point_from(derivatives(at.numbers.x(), at.numbers.y()));
}

SurfacePoint Patch::evaluate_frame(const Place& at) const {
  const bool cubic = u_.degree == 3 && v_.degree == 3;
  return point_from(cubic ? bicubic_derivatives(at.numbers.x(), at.numbers.y(), false)
                          : general_derivatives(at.numbers.x(), at.numbers.y()));
}

/// Normal, reciprocal base g_u, g_v and K = Σ (n.c_ab) g_a g_b.
CONDYLE_FMA_CLONE
SurfacePoint Patch::point_from(const PatchDerivatives& d) const {
  const Eigen::Vector3d N = d.c_u.cross(d.c_v);
  const double area = std::max(N.norm(), 1e-150);  // whose square is a number
  const double E = d.c_u.squaredNorm(), F = d.c_u.dot(d.c_v), G = d.c_v.squaredNorm();
  const double inverse = 1 / (area * area);
  SurfacePoint point;
  point.c = d.c;
  point.n = N * (data_.orientation / area);
  const Eigen::Vector3d g_u = (G * d.c_u - F * d.c_v) * inverse;
  const Eigen::Vector3d g_v = (E * d.c_v - F * d.c_u) * inverse;
  const double K_uu = point.n.dot(d.c_uu), K_uv = point.n.dot(d.c_uv), K_vv = point.n.dot(d.c_vv);
  const Eigen::Vector3d k_u = K_uu * g_u + K_uv * g_v, k_v = K_uv * g_u + K_vv * g_v;
  point.K.noalias() = g_u * k_u.transpose();
  point.K.noalias() += g_v * k_v.transpose();
  point.dual.col(0) = g_u;
  point.dual.col(1) = g_v;
  return point;
}

Place Patch::moved(const Place& from, const SurfacePoint& at, const Eigen::Vector3d& dc) const {
  return place(from.numbers.x() + at.dual.col(0).dot(dc),
               from.numbers.y() + at.dual.col(1).dot(dc));
}

Place Patch::closest(const Eigen::Vector3d& p, const Place& start) const {
  // Newton on grad |c(u,v) - p|²/2 = 0, Gauss-Newton where the Hessian is not positive definite.
  const double reach_u = 0.15 * (u_.max - u_.min), reach_v = 0.15 * (v_.max - v_.min);
  Eigen::Vector2d x(start.numbers.x(), start.numbers.y());
  for (int iteration = 0; iteration < 30; ++iteration) {
    const PatchDerivatives d = derivatives(x[0], x[1]);
    const Eigen::Vector3d r = d.c - p;
    const Eigen::Vector2d g(r.dot(d.c_u), r.dot(d.c_v));
    const double a = d.c_u.squaredNorm(), b = d.c_u.dot(d.c_v), c = d.c_v.squaredNorm();
    double h00 = a + r.dot(d.c_uu), h01 = b + r.dot(d.c_uv), h11 = c + r.dot(d.c_vv);
    if (h00 <= 0.05 * a || h00 * h11 - h01 * h01 <= 0.0025 * a * c) h00 = a, h01 = b, h11 = c;
    const double det = h00 * h11 - h01 * h01;
    Eigen::Vector2d step(-(h11 * g[0] - h01 * g[1]) / det, -(h00 * g[1] - h01 * g[0]) / det);
    const double length = std::sqrt(a * step[0] * step[0] + c * step[1] * step[1]);
    if (!(length < 1e300)) return place(x[0], x[1]);
    const double longest = 0.15 * size_;
    if (length > longest) step *= longest / length;
    const Eigen::Vector2d next(std::clamp(x[0] + step[0], u_.min - reach_u, u_.max + reach_u),
                               std::clamp(x[1] + step[1], v_.min - reach_v, v_.max + reach_v));
    const double change = (next - x).lpNorm<Eigen::Infinity>();
    x = next;
    if (change < 1e-13 * size_ || length < 1e-13 * size_) break;
  }
  return place(x[0], x[1]);
}

Place Patch::seed(const Eigen::Vector3d& p) const {
  const Eigen::Vector3d where_laid = p - seeds_moved_;
  return seeds_->places[nearest_point(*seeds_->tree, where_laid).index];
}

double Patch::edge_distance(const Place& at) const {
  const double x = at.numbers.x(), y = at.numbers.y();
  const double u = std::clamp(x, u_.min, u_.max), v = std::clamp(y, v_.min, v_.max);
  const double outside = x == u && y == v ? 0 : std::hypot(x - u, y - v);
  const double inside =
      std::min(std::min(u - u_.min, u_.max - u), std::min(v - v_.min, v_.max - v));
  if (data_.mask.empty()) return outside > 0 ? -outside : inside;
  const double s = (u - u_.min) / (u_.max - u_.min) * data_.mask_nu;
  const double t = (v - v_.min) / (v_.max - v_.min) * data_.mask_nv;
  // In this order: what is no number becomes 0.
  const int i = static_cast<int>(std::min(data_.mask_nu - 1.0, std::max(0.0, s)));
  const int j = static_cast<int>(std::min(data_.mask_nv - 1.0, std::max(0.0, t)));
  const double a = s - i, b = t - j;
  const double* m = &data_.mask[static_cast<std::size_t>(i) * (data_.mask_nv + 1) + j];
  const double* m_next = m + data_.mask_nv + 1;
  const double known =
      (1 - a) * ((1 - b) * m[0] + b * m[1]) + a * ((1 - b) * m_next[0] + b * m_next[1]);
  return outside > 0 ? std::min(known, 0.0) - outside : known;
}

std::vector<Place> Patch::samples(double spacing) const {
  // Arc lengths of the middle lines set the steps.
  const double um = (u_.min + u_.max) / 2, vm = (v_.min + v_.max) / 2;
  double length_u = 0, length_v = 0;
  constexpr int kPieces = 64;
  for (int k = 0; k < kPieces; ++k) {
    const double t = (k + 0.5) / kPieces;
    length_u +=
        derivatives(u_.min + t * (u_.max - u_.min), vm).c_u.norm() * (u_.max - u_.min) / kPieces;
    length_v +=
        derivatives(um, v_.min + t * (v_.max - v_.min)).c_v.norm() * (v_.max - v_.min) / kPieces;
  }
  const int nu = std::max(2, static_cast<int>(std::ceil(length_u / spacing)));
  const int nv = std::max(2, static_cast<int>(std::ceil(length_v / spacing)));
  std::vector<Place> places;
  for (int i = 0; i <= nu; ++i)
    for (int j = 0; j <= nv; ++j) {
      const Place at =
          place(u_.min + (u_.max - u_.min) * i / nu, v_.min + (v_.max - v_.min) * j / nv);
      if (edge_distance(at) >= 0) places.push_back(at);
    }
  return places;
}

}  // namespace condyle
