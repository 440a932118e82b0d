#include "condyle/wrapping/touching_line.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "condyle/wrapping/shape_geometry.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

/// M of a quadric xᵀMx = 1, diagonal.
Vector3d quadric(const WrapSphere& s) { return Vector3d::Constant(1 / (s.radius * s.radius)); }
Vector3d quadric(const WrapCylinder& c) { return Vector3d(1, 1, 0) / (c.radius * c.radius); }
Vector3d quadric(const WrapEllipsoid& e) { return e.semi_axes.cwiseAbs2().cwiseInverse(); }

/// Of xᵀMx along the line, M d . d = 0 being a cylinder's axis.
double lowest(const Vector3d& M, const Vector3d& U, const Vector3d& d) {
  const Vector3d Md = M.cwiseProduct(d);
  const double dMd = d.dot(Md);
  return dMd > 0 ? std::clamp(-U.dot(Md) / dMd, 0.0, 1.0) : 0.5;
}

template <class Quadric>
double clearance_of(
    const Quadric& solid, const WrapShape&, const Vector3d& U, const Vector3d& V, double* part) {
  const Vector3d M = quadric(solid);
  const double at = lowest(M, U, V - U);
  if (part != nullptr) *part = at;
  const Vector3d x = U + at * (V - U);
  const Vector3d Mx = M.cwiseProduct(x);
  const double level = std::sqrt(x.dot(Mx)), steep = Mx.norm();
  return steep > 0 ? (level - 1) * level / steep : -1 / std::sqrt(M.maxCoeff());
}

struct LineMinimum {
  double at, height;
};

/// Golden section between two places of which one between is lower.
template <class Height>
LineMinimum lowest_between(double low, double high, const Height& height) {
  constexpr double kGolden = 0.6180339887498949;
  double left = high - kGolden * (high - low), right = low + kGolden * (high - low);
  double at_left = height(left), at_right = height(right);
  for (int k = 0; k < 40; ++k) {
    if (at_left < at_right) {
      high = std::exchange(right, left);
      at_right = at_left;
      at_left = height(left = high - kGolden * (high - low));
    } else {
      low = std::exchange(left, right);
      at_left = at_right;
      at_right = height(right = low + kGolden * (high - low));
    }
  }
  const double at = 0.5 * (low + high);
  return {at, height(at)};
}

/// From where to where, from 0 at U to 1 at V, a line may be lower over a ring than `height` at its point nearest to
/// the centre: farther from the centre than the ring's outside and that it is not.
std::array<double, 2> part_beside(const WrapTorus& torus,
                                  const Vector3d& U,
                                  const Vector3d& d,
                                  double height) {
  const double length = d.norm(), way = -U.dot(d) / length;
  const double far = torus.ring + torus.tube + std::max(height, 0.0);
  const double half = std::sqrt(std::max(far * far - (U.squaredNorm() - way * way), 0.0));
  return {std::clamp(way - half, 0.0, length) / length,
          std::clamp(way + half, 0.0, length) / length};
}

/// Depth on a line that may have several deepest points: golden section at each sample that is lower than its
/// neighbours and may be lowest, as the height changes by no more than the way.
double clearance_of(const WrapTorus& torus,
                    const WrapShape& shape,
                    const Vector3d& U,
                    const Vector3d& V,
                    double* part) {
  constexpr std::size_t kSamples = 49;
  const Vector3d d = V - U;
  const double square = d.squaredNorm();
  const auto height = [&](double at) { return signed_distance(shape, U + at * d); };
  const auto minimum = [&](double at) { return LineMinimum{at, height(at)}; };
  LineMinimum least = minimum(square > 0 ? std::clamp(-U.dot(d) / square, 0.0, 1.0) : 0);
  const std::array<double, 2> ends =
      square > 0 ? part_beside(torus, U, d, least.height) : std::array{0., 0.};
  const double first = ends[0], last = ends[1];  // Clang 14 captures no structured binding
  if (last > first) {
    const double step = (last - first) / (kSamples - 1);
    std::array<double, kSamples + 2> h;  // and one more on either side
    h.front() = h.back() = std::numeric_limits<double>::infinity();
    const auto at = [&](std::size_t k) { return first + (static_cast<double>(k) - 1) * step; };
    // cppcheck-suppress containerOutOfBounds; cppcheck 2.10 takes h for two elements shorter
    for (std::size_t k = 1; k <= kSamples; ++k) h[k] = height(at(k));
    const double lowest = std::min(least.height, *std::min_element(h.begin(), h.end()));
    for (std::size_t k = 1; k <= kSamples; ++k) {
      if (h[k] > std::min(h[k - 1], h[k + 1]) || h[k] - step * d.norm() > lowest) continue;
      const LineMinimum between =
          lowest_between(std::max(at(k - 1), first), std::min(at(k + 1), last), height);
      for (const LineMinimum& found : {LineMinimum{at(k), h[k]}, between})
        if (found.height < least.height) least = found;
    }
  }
  if (part != nullptr) *part = least.at;
  return least.height;
}

/// Seen along the line the quadric is the ellipse xᵀNx = 1, N = M - M d dᵀM/dᵀMd, and the line is a point.
template <class Quadric>
std::optional<TouchingLine> touching(const Quadric& solid,
                                     const WrapShape&,
                                     const Vector3d& U,
                                     const Vector3d& V,
                                     const Vector3d& w) {
  const Vector3d M = quadric(solid), d = V - U, Md = M.cwiseProduct(d);
  const double dMd = d.dot(Md);
  const auto N = [&](const Vector3d& u, const Vector3d& v) {
    return u.dot(M.cwiseProduct(v)) - (dMd > 0 ? u.dot(Md) * v.dot(Md) / dMd : 0);
  };
  const double a = N(w, w), b = N(U, w), c = N(U, U) - 1, root = b * b - a * c;
  if (!(a > 0) || !(root > 0)) return std::nullopt;
  TouchingLine line{w, (-b + std::sqrt(root)) / a, {}, 0.5};
  const Vector3d shifted = U + line.shift * w;
  if (dMd > 0) line.part = -shifted.dot(Md) / dMd;
  line.point = shifted + line.part * d;
  return line;
}

/// Pushed along w by what it still lies inside until it is clear.
std::optional<TouchingLine> touching(const WrapTorus& torus,
                                     const WrapShape& shape,
                                     const Vector3d& U,
                                     const Vector3d& V,
                                     const Vector3d& w) {
  TouchingLine line{w, 0, {}, 0.5};
  for (int k = 0; k < 100; ++k) {
    const Vector3d aside = line.shift * w;
    const double height = clearance_of(torus, shape, U + aside, V + aside, &line.part);
    line.point = U + aside + line.part * (V - U);
    if (std::abs(height) < 1e-9 * torus.tube) break;
    const double steep = normal_at(shape, line.point).dot(w);
    const double newton = steep > 0.2 ? -height / steep : -height;
    line.shift += std::min(newton, 0.5 * torus.tube);
    if (line.shift > 2 * (torus.ring + torus.tube)) return std::nullopt;
  }
  line.point = onto_surface(shape, line.point);
  if (!(frame_at(shape, line.point, V - U).kappa < 0)) return std::nullopt;
  return line;
}

}  // namespace

double clearance(const WrapShape& shape, const Vector3d& U, const Vector3d& V, double* part) {
  return std::visit([&](const auto& solid) { return clearance_of(solid, shape, U, V, part); },
                    shape);
}

std::optional<TouchingLine> touching_line(const WrapShape& shape,
                                          const Vector3d& U,
                                          const Vector3d& V,
                                          const Vector3d& w) {
  return std::visit([&](const auto& solid) { return touching(solid, shape, U, V, w); }, shape);
}

std::optional<TouchingLine> nearest_touching_line(const WrapShape& shape,
                                                  const Vector3d& U,
                                                  const Vector3d& V) {
  const Vector3d d = (V - U).normalized(), w1 = d.unitOrthogonal(), w2 = d.cross(w1);
  const bool torus = std::holds_alternative<WrapTorus>(shape);
  std::optional<TouchingLine> best;
  double best_angle = 0;
  const auto between = [](const TouchingLine& line) {
    return line.part > 0.01 && line.part < 0.99;
  };
  if (torus) {
    // The normal where the line lies deepest, if the tube is round there as the line runs.
    double part = 0;
    (void)clearance(shape, U, V, &part);
    const Vector3d n = normal_at(shape, U + part * (V - U)), w = n - n.dot(d) * d;
    if (w.norm() > 0.5) best = touching_line(shape, U, V, w.normalized());
    if (best && between(*best)) return best;
    best.reset();
  }
  const auto try_angle = [&](double angle) {
    const auto line = touching_line(shape, U, V, std::cos(angle) * w1 + std::sin(angle) * w2);
    if (!line) return;
    const bool better = !best || (between(*line) && !between(*best)) ||
                        (between(*line) == between(*best) && line->shift < best->shift);
    if (better) {
      best = line;
      best_angle = angle;
    }
  };
  const int directions = torus ? 24 : 48;
  for (int k = 0; k < directions; ++k) try_angle(2 * M_PI * k / directions);
  for (double step = M_PI / directions; step > (torus ? 0.02 : 1e-4); step *= 0.5) {
    const double middle = best_angle;
    try_angle(middle - step);
    try_angle(middle + step);
  }
  return best;
}

}  // namespace condyle
