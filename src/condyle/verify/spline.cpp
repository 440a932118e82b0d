#include "condyle/verify/spline.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "condyle/verify/parts.h"

namespace condyle::verification {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr std::size_t kMost = 6;  ///< control points that a place depends on, in one direction

/// The index k of the knot span t_k <= t < t_k+1; the last span holds the end of the domain.
std::size_t span_of(const std::vector<double>& t, std::size_t degree, double x) {
  const auto first = t.begin() + static_cast<std::ptrdiff_t>(degree) + 1;
  const auto last = t.end() - static_cast<std::ptrdiff_t>(degree) - 1;
  return static_cast<std::size_t>(std::upper_bound(first, last, x) - t.begin()) - 1;
}

template <typename Point>
struct CurvePoint {
  Point c, d, dd;  ///< value, first and second derivative
};

/// De Boor's triangle over d[0..p], the control points k-p..k; the derivatives are differences of
/// its last but one and last but two rows.
template <typename Point>
CurvePoint<Point> de_boor(
    const std::vector<double>& t, std::size_t p, std::size_t k, double x, Point* d) {
  CurvePoint<Point> out;
  const auto degree = static_cast<double>(p);
  for (std::size_t r = 1; r <= p; ++r) {
    if (r == p - 1)  // d[p-2], d[p-1], d[p] are the row p-2
      out.dd =
          degree * (degree - 1) / (t[k + 1] - t[k]) *
          ((d[p] - d[p - 1]) / (t[k + 2] - t[k]) - (d[p - 1] - d[p - 2]) / (t[k + 1] - t[k - 1]));
    if (r == p) out.d = degree / (t[k + 1] - t[k]) * (d[p] - d[p - 1]);
    for (std::size_t j = p; j >= r; --j) {
      const double left = t[k - p + j], right = t[k + 1 + j - r];
      const double a = (x - left) / (right - left);
      d[j] = (1 - a) * d[j - 1] + a * d[j];
    }
  }
  out.c = d[p];
  return out;
}

}  // namespace

SplineBox spline_box(const PatchData& patch) {
  const auto p = static_cast<std::size_t>(patch.degree[0]),
             q = static_cast<std::size_t>(patch.degree[1]);
  return {patch.knots_u[p], patch.knots_u[patch.knots_u.size() - 1 - p], patch.knots_v[q],
          patch.knots_v[patch.knots_v.size() - 1 - q]};
}

SplinePoint spline_point(const PatchData& patch, double u, double v) {
  const SplineBox box = spline_box(patch);
  u = std::clamp(u, box.u0, box.u1);
  v = std::clamp(v, box.v0, box.v1);
  const auto p = static_cast<std::size_t>(patch.degree[0]),
             q = static_cast<std::size_t>(patch.degree[1]);
  const std::size_t i = span_of(patch.knots_u, p, u), j = span_of(patch.knots_v, q, v);
  std::array<Vector3d, kMost> row;
  std::array<Matrix3d, kMost> across;  // columns c, c_v, c_vv
  for (std::size_t a = 0; a <= p; ++a) {
    const Vector3d* net =
        &patch.control_points[(i - p + a) * static_cast<std::size_t>(patch.nv) + j - q];
    std::copy_n(net, q + 1, row.begin());
    const CurvePoint<Vector3d> curve = de_boor(patch.knots_v, q, j, v, row.data());
    across[a] << curve.c, curve.d, curve.dd;
  }
  const CurvePoint<Matrix3d> along = de_boor(patch.knots_u, p, i, u, across.data());
  return {along.c.col(0),  along.d.col(0), along.c.col(1),
          along.dd.col(0), along.d.col(1), along.c.col(2)};
}

double mask_distance(const PatchData& patch, double u, double v) {
  const SplineBox box = spline_box(patch);
  if (patch.mask.empty())
    return std::min(std::min(u - box.u0, box.u1 - u), std::min(v - box.v0, box.v1 - v));
  const double s = std::clamp((u - box.u0) / (box.u1 - box.u0), 0.0, 1.0) * patch.mask_nu;
  const double t = std::clamp((v - box.v0) / (box.v1 - box.v0), 0.0, 1.0) * patch.mask_nv;
  const int i = parts_of(std::floor(s), 0, patch.mask_nu - 1),
            j = parts_of(std::floor(t), 0, patch.mask_nv - 1);
  const auto corner = [&](std::size_t a, std::size_t b) {
    const std::size_t row = static_cast<std::size_t>(i) + a,
                      column = static_cast<std::size_t>(j) + b;
    return patch.mask[row * (static_cast<std::size_t>(patch.mask_nv) + 1) + column];
  };
  const double x = s - i, y = t - j;
  const double low = corner(0, 0) + y * (corner(0, 1) - corner(0, 0));
  const double high = corner(1, 0) + y * (corner(1, 1) - corner(1, 0));
  return low + x * (high - low);
}

}  // namespace condyle::verification
