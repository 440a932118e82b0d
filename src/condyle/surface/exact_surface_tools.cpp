#include "condyle/surface/exact_surface_tools.h"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <limits>
#include <numbers>

#include "condyle/input_error.h"
#include "condyle/surface/exact_charts.h"

namespace condyle {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

Vector3d checked_direction(const Vector3d& direction, const char* what) {
  const double length = direction.norm();
  if (length > 0 && std::isfinite(length)) return direction / length;
  throw InputError(fmt::format("{} = [{}, {}, {}], expected a vector other than zero", what,
                               direction.x(), direction.y(), direction.z()));
}

double checked_length(double length, const char* what) {
  if (length > 0 && std::isfinite(length)) return length;
  throw InputError(fmt::format("{} = {}, expected a length > 0", what, length));
}

double checked_bound(double bound, const char* what) {
  if (bound > 0) return bound;
  throw InputError(fmt::format("{} = {}, expected a length > 0", what, bound));
}

Matrix3d checked_axes(const Matrix3d& axes, const char* what) {
  if ((axes.transpose() * axes - Matrix3d::Identity()).norm() < 1e-9) return axes;
  throw InputError(fmt::format(
      "{}: not at right angles or not of length 1, expected three unit vectors at right angles",
      what));
}

namespace {

/// Minimum of the quadratic model of ½|p - c|² in the tangent plane, `gradient` being its negative
/// slope. Where the model has no minimum, a descent that also leaves a saddle or a maximum.
Vector2d model_step(const Matrix2d& hessian, const Vector2d& gradient, double distance) {
  const double mean = hessian.trace() / 2, difference = (hessian(0, 0) - hessian(1, 1)) / 2,
               off = hessian(0, 1);
  const double radius = std::hypot(difference, off);
  const double lowest = mean - radius;
  if (lowest > 1e-9) {
    return Vector2d(hessian(1, 1) * gradient[0] - off * gradient[1],
                    hessian(0, 0) * gradient[1] - off * gradient[0]) /
           hessian.determinant();
  }
  const double angle = std::atan2(off, difference) / 2;  // of the stiffest direction
  Vector2d softest(-std::sin(angle), std::cos(angle));
  if (softest.dot(gradient) < 0) softest = -softest;
  return gradient / std::max(1.0, mean + radius) + 1e-3 * distance * softest;
}

struct Trial {
  Place place;
  double length;  ///< of the tangent displacement taken
  bool accepted;
};

/// The full step, or the first of its halves, quarters ... that does not increase the distance.
Trial shortened_step(const Surface& surface,
                     const Vector3d& p,
                     const Place& x,
                     const SurfacePoint& at,
                     Vector3d dc) {
  const double square = (p - x.numbers).squaredNorm();
  const double round_off = 16 * std::numeric_limits<double>::epsilon() *
                           (square + std::sqrt(square) * (p.norm() + x.numbers.norm()));
  for (int halvings = 0; halvings < 40; ++halvings, dc /= 2) {
    const Place y = surface.moved(x, at, dc);
    if ((p - y.numbers).squaredNorm() <= square + round_off) return {y, dc.norm(), true};
  }
  return {x, 0, false};
}

}  // namespace

Place closest_by_newton(const Surface& surface, const Vector3d& p, const Place& start) {
  Place x = surface.moved(start, surface.evaluate(start), Vector3d::Zero());
  double last_length = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < 100; ++iteration) {
    const SurfacePoint at = surface.evaluate(x);
    const Vector3d r = p - at.c;
    Eigen::Matrix<double, 3, 2> T;
    T.col(0) = at.n.unitOrthogonal();
    T.col(1) = at.n.cross(T.col(0));
    const Matrix2d hessian = Matrix2d::Identity() - at.n.dot(r) * (T.transpose() * at.K * T);
    const Vector2d gradient = T.transpose() * r;
    const Trial trial =
        shortened_step(surface, p, x, at, T * model_step(hessian, gradient, r.norm()));
    if (!trial.accepted) return x;
    x = trial.place;
    const double scale = x.numbers.norm() + p.norm();
    if (trial.length <= 1e-16 * scale) return x;
    if (trial.length < 1e-10 * scale && trial.length >= last_length)
      return x;  // only round-off is left
    last_length = trial.length;
  }
  return x;
}

namespace {

/// The arc of an ellipse, points (a cos θ, b sin θ) for θ in [from, to].
class EllipseArc {
 public:
  EllipseArc(double a, double b, double from, double to)
      : from_(from), to_(to), arc_(kFine + 1, 0.0) {
    for (int i = 0; i < kFine; ++i) {
      const double middle = from + (i + 0.5) * step();
      arc_[i + 1] = arc_[i] + step() * std::hypot(a * std::sin(middle), b * std::cos(middle));
    }
  }
  /// Parameters that divide it into equal parts of about `spacing`, both ends among them.
  [[nodiscard]] std::vector<double> evenly_spaced(double spacing, int least) const {
    const int parts = std::max(least, static_cast<int>(std::ceil(arc_.back() / spacing)));
    std::vector<double> angles = {from_};
    int i = 0;
    for (int part = 1; part < parts; ++part) {
      const double wanted = arc_.back() * part / parts;
      while (arc_[i + 1] < wanted) ++i;
      angles.push_back(from_ + step() * (i + (wanted - arc_[i]) / (arc_[i + 1] - arc_[i])));
    }
    angles.push_back(to_);
    return angles;
  }

 private:
  static constexpr int kFine = 512;
  [[nodiscard]] double step() const { return (to_ - from_) / kFine; }

  double from_, to_;
  std::vector<double> arc_;  // from the first point, equal steps of θ apart
};

}  // namespace

std::vector<Place> ellipsoid_samples(const Vector3d& center,
                                     const Matrix3d& axes,
                                     const Vector3d& semi_axes,
                                     double spacing) {
  constexpr double pi = std::numbers::pi;
  int polar = 0;
  semi_axes.maxCoeff(&polar);
  const int x = (polar + 1) % 3, y = (polar + 2) % 3;
  const double widest = std::max(semi_axes[x], semi_axes[y]);
  const EllipseArc meridian(semi_axes[polar], widest, 0, pi);
  const EllipseArc equator(semi_axes[x], semi_axes[y], 0, 2 * pi);  // rings are of its shape
  std::vector<Place> places;
  for (const double latitude : meridian.evenly_spaced(spacing, 4)) {
    const double size = std::sin(latitude), a = semi_axes[x] * size, b = semi_axes[y] * size;
    std::vector<double> ring = {0, 0};  // a pole; the last angle repeats the first
    if (size > 1e-9) ring = equator.evenly_spaced(spacing / size, 4);
    ring.pop_back();
    for (const double angle : ring) {
      places.push_back({center + a * std::cos(angle) * axes.col(x) +
                        b * std::sin(angle) * axes.col(y) +
                        semi_axes[polar] * std::cos(latitude) * axes.col(polar)});
    }
  }
  return places;
}

std::vector<Place> torus_samples(
    const Vector3d& center, const Vector3d& axis, double major, double minor, double spacing) {
  constexpr double pi = std::numbers::pi;
  const Vector3d x = axis.unitOrthogonal(), y = axis.cross(x);
  const auto parts = [spacing](double radius) {
    return std::max(4, static_cast<int>(std::ceil(2 * pi * radius / spacing)));
  };
  std::vector<Place> places;
  const int rings = parts(minor);
  for (int i = 0; i < rings; ++i) {
    const double tube = 2 * pi * i / rings, radius = major + minor * std::cos(tube);
    const int along = parts(radius);
    for (int j = 0; j < along; ++j) {
      const double angle = 2 * pi * j / along;
      places.push_back({center + radius * (std::cos(angle) * x + std::sin(angle) * y) +
                        minor * std::sin(tube) * axis});
    }
  }
  return places;
}

std::vector<Vector2d> disc_samples(double radius, double spacing) {
  const int rings = std::max(2, static_cast<int>(std::ceil(radius / spacing)));
  std::vector<Vector2d> samples = {Vector2d::Zero()};
  for (int ring = 1; ring <= rings; ++ring) {
    const double r = radius * ring / rings;
    const int count = std::max(6, static_cast<int>(std::ceil(2 * std::numbers::pi * r / spacing)));
    for (int k = 0; k < count; ++k) {
      const double angle = 2 * std::numbers::pi * k / count;
      samples.emplace_back(r * std::cos(angle), r * std::sin(angle));
    }
  }
  return samples;
}

std::vector<Place> cylinder_samples(
    const Vector3d& center, const Vector3d& axis, double radius, double length, double spacing) {
  const Vector3d x = axis.unitOrthogonal(), y = axis.cross(x);
  const int parts = std::max(1, static_cast<int>(std::ceil(length / spacing)));
  const int round =
      std::max(6, static_cast<int>(std::ceil(2 * std::numbers::pi * radius / spacing)));
  std::vector<Place> places;
  for (int i = 0; i <= parts; ++i) {
    const Vector3d middle = center + length * (static_cast<double>(i) / parts - 0.5) * axis;
    for (int k = 0; k < round; ++k) {
      const double angle = 2 * std::numbers::pi * k / round;
      places.push_back({middle + radius * (std::cos(angle) * x + std::sin(angle) * y)});
    }
  }
  return places;
}

/// q = (tan ξ, tan η, ±1) on a face, s = q/|q| on the unit sphere, c = A diag(a) s.
std::vector<SurfaceChart> ellipsoid_charts(const Eigen::Vector3d& center,
                                           const Eigen::Matrix3d& axes,
                                           const Eigen::Vector3d& semi_axes) {
  const double length = semi_axes.maxCoeff(), end = std::numbers::pi / 4 * length;
  const Eigen::Matrix3d stretch = axes * semi_axes.asDiagonal();
  std::vector<SurfaceChart> faces;
  for (const int k : {0, 1, 2})
    for (const int sign : {1, -1}) {
      const auto at = [=](double u, double v) {
        const double x = std::tan(u / length), y = std::tan(v / length);
        Eigen::Vector3d q, q_u = Eigen::Vector3d::Zero(), q_v = Eigen::Vector3d::Zero();
        q[k] = sign;
        q[(k + 1) % 3] = x;
        q[(k + 2) % 3] = y;
        q_u[(k + 1) % 3] = (1 + x * x) / length;
        q_v[(k + 2) % 3] = (1 + y * y) / length;
        const double size = q.norm();
        const Eigen::Vector3d s = q / size;
        const Eigen::Vector3d s_u = (q_u - s.dot(q_u) * s) / size,
                              s_v = (q_v - s.dot(q_v) * s) / size;
        return SurfaceChart::At{center + stretch * s, (stretch * s_u).cross(stretch * s_v).norm()};
      };
      faces.push_back({-end, end, -end, end, at});
    }
  return faces;
}

}  // namespace condyle
