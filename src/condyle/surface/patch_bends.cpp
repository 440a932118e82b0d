#include "condyle/surface/patch_bends.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace condyle {
namespace {

using Eigen::Vector3d;

/// Bézier points of a polynomial on a cell, whose sides are 1 long.
struct BezierNet {
  int degree_u = 3, degree_v = 3;
  Vector3d p[4][4];
};

BezierNet bezier_net(const PatchCells::Cell& cell, double du, double dv) {
  // Bernstein's polynomials have Σ_k t_ik of the coefficients of x^k.
  constexpr double kThird = 1. / 3;
  constexpr double t[4][4] = {
      {1, 0, 0, 0}, {1, kThird, 0, 0}, {1, 2 * kThird, kThird, 0}, {1, 1, 1, 1}};
  const double scale_u[] = {1, du, du * du, du * du * du},
               scale_v[] = {1, dv, dv * dv, dv * dv * dv};
  Vector3d half[4][4];  // Bézier points by u, powers by v
  for (int i = 0; i < 4; ++i)
    for (int l = 0; l < 4; ++l) {
      half[i][l].setZero();
      for (int k = 0; k <= i; ++k)
        half[i][l] += t[i][k] * scale_u[k] * scale_v[l] * Vector3d::Map(cell.a[k][l]);
    }
  BezierNet net;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      net.p[i][j].setZero();
      for (int l = 0; l <= j; ++l) net.p[i][j] += t[j][l] * half[i][l];
    }
  return net;
}

BezierNet derivative_by_u(const BezierNet& f) {
  BezierNet d{f.degree_u - 1, f.degree_v, {}};
  for (int i = 0; i <= d.degree_u; ++i)
    for (int j = 0; j <= d.degree_v; ++j) d.p[i][j] = f.degree_u * (f.p[i + 1][j] - f.p[i][j]);
  return d;
}

BezierNet derivative_by_v(const BezierNet& f) {
  BezierNet d{f.degree_u, f.degree_v - 1, {}};
  for (int i = 0; i <= d.degree_u; ++i)
    for (int j = 0; j <= d.degree_v; ++j) d.p[i][j] = f.degree_v * (f.p[i][j + 1] - f.p[i][j]);
  return d;
}

/// The greatest of a convex function over a cell is that over the points.
template <typename Convex>
double greatest(const BezierNet& f, const Convex& convex) {
  double most = convex(f.p[0][0]);
  for (int i = 0; i <= f.degree_u; ++i)
    for (int j = 0; j <= f.degree_v; ++j) most = std::max<double>(most, convex(f.p[i][j]));
  return most;
}

Vector3d mean(const BezierNet& f) {
  Vector3d sum = Vector3d::Zero();
  for (int i = 0; i <= f.degree_u; ++i)
    for (int j = 0; j <= f.degree_v; ++j) sum += f.p[i][j];
  return sum / ((f.degree_u + 1) * (f.degree_v + 1));
}

/// The greatest of the quadratic form a x² + 2 b x y + c y² on unit vectors.
double most_of_form(double a, double b, double c) {
  return 0.5 * (a + c) + std::hypot(0.5 * (a - c), b);
}

/// How far the cell bends towards the side of its normal, over which its solid does not lie.
/// With m between the tangents of the cell and J = (m_u, m_v): |c_a w^a| >= (σ_min(J) - spread) |w|
/// =: stretch |w|. Where n_m is normal to m_u and m_v, unit tangents lean by n_m·t out of that plane,
/// and n by the same angle from n_m. Curvatures are n·c_ab w^a w^b at |c_a w^a| = 1.
/// `way`: that across the cell at least.
BendBound bend_of_cell(const BezierNet& c, int orientation) {
  constexpr double kMostLean = 0.7;     // sine
  constexpr double kChordOfLean = 1.1;  // |n - n_m| over the sine up to there
  const BezierNet u = derivative_by_u(c), v = derivative_by_v(c), uu = derivative_by_u(u),
                  uv = derivative_by_v(u), vv = derivative_by_v(v);
  const Vector3d m_u = mean(u), m_v = mean(v), n = orientation * m_u.cross(m_v).normalized();
  const auto from = [](const Vector3d& m) {
    return [&m](const Vector3d& x) { return (x - m).norm(); };
  };
  const auto along_n = [&n](const Vector3d& x) { return std::abs(n.dot(x)); };
  const auto by_normal = [&n](const Vector3d& x) { return n.dot(x); };
  const auto length = [](const Vector3d& x) { return x.norm(); };
  const double a = m_u.squaredNorm(), b = m_u.dot(m_v), d = m_v.squaredNorm();
  const double least = std::sqrt(std::max(0.0, 0.5 * (a + d) - std::hypot(0.5 * (a - d), b)));
  const double stretch = least - std::hypot(greatest(u, from(m_u)), greatest(v, from(m_v)));
  if (!(stretch > 0)) return {};
  const double lean = std::hypot(greatest(u, along_n), greatest(v, along_n)) / stretch;
  if (!(lean < kMostLean)) return {};
  const double by_n =
      most_of_form(greatest(uu, by_normal), greatest(uv, along_n), greatest(vv, by_normal));
  const double by_any =
      most_of_form(greatest(uu, length), greatest(uv, length), greatest(vv, length));
  const double most = std::max(0.0, by_n + kChordOfLean * lean * by_any) / (stretch * stretch);
  return {most, stretch};
}

}  // namespace

PatchBends::PatchBends(const PatchCells& cells) : cells_(cells) {
  const auto [nu, nv] = cells.counts();
  std::vector<BendBound> own;
  for (int i = 0; i < nu; ++i)
    for (int j = 0; j < nv; ++j)
      own.push_back(
          bend_of_cell(bezier_net(cells.cell(i, j), cells.sides(i, j)[0], cells.sides(i, j)[1]),
                       cells.orientation()));
  about_.resize(own.size());
  // Who leaves a cell and its neighbours has gone across one of these.
  for (int i = 1; i + 1 < nu; ++i)
    for (int j = 1; j + 1 < nv; ++j) {
      BendBound& all = about_[static_cast<std::size_t>(i) * nv + j];
      all = {0, std::numeric_limits<double>::infinity()};
      for (int k = -1; k <= 1; ++k)
        for (int l = -1; l <= 1; ++l) {
          const BendBound& one = own[static_cast<std::size_t>(i + k) * nv + j + l];
          all.most = std::max(all.most, one.most);
          all.way = std::min(all.way, one.way);
        }
    }
}

const BendBound& PatchBends::about(double u, double v) const {
  const std::array<int, 2> at = cells_.cell_of(u, v);
  return at[0] < 0 ? unknown_
                   : about_[static_cast<std::size_t>(at[0]) * cells_.counts()[1] + at[1]];
}

}  // namespace condyle
