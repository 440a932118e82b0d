#include "condyle/wrapping/geodesic.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "condyle/wrapping/nystrom.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

Geodesic shoot_on(const WrapSphere& sphere,
                  const WrapShape&,
                  const SurfaceFrame& from,
                  double arc) {
  const double R = sphere.radius, c = std::cos(arc / R), s = std::sin(arc / R);
  Geodesic g;
  g.from = g.to = from;
  g.to.n = c * from.n + s * from.t;
  g.to.t = c * from.t - s * from.n;
  g.to.x = R * g.to.n;
  g.a = g.dr = c;
  g.da = -s / R;
  g.r = R * s;
  g.first_of_kind = std::abs(arc) < M_PI * R;
  return g;
}

Geodesic shoot_on(const WrapCylinder& cylinder,
                  const WrapShape&,
                  const SurfaceFrame& from,
                  double arc) {
  const Vector3d round(-from.n.y(), from.n.x(), 0);
  const double along = from.t.dot(round), angle = arc * along / cylinder.radius;
  const double c = std::cos(angle), s = std::sin(angle);
  const auto turned = [&](const Vector3d& v) {
    return Vector3d(c * v.x() - s * v.y(), s * v.x() + c * v.y(), v.z());
  };
  Geodesic g;
  g.from = g.to = from;
  g.to.n = turned(from.n);
  g.to.t = turned(from.t);
  g.to.b = turned(from.b);
  g.to.x = cylinder.radius * g.to.n;
  g.to.x.z() = from.x.z() + arc * from.t.z();
  g.r = arc;
  return g;
}

double inverse_root(double x) { return 1 / std::sqrt(x); }
inline __attribute__((always_inline)) Four inverse_root(const Four& x) {
  const Four roots = {std::sqrt(x[0]), std::sqrt(x[1]), std::sqrt(x[2]), std::sqrt(x[3])};
  return 1.0 / roots;
}

/// Fields tell s of f_i = factor_i s_i y_i (nystrom.h), the first three y being scale_i x_i.
/// x'' = -J D x/q², q = |Dx|²: J = q tᵀDt stays along a geodesic [Joachimsthal]. G = det D/q².
struct EllipsoidField {
  Vector3d per_scale, scale;
  double factor[5];

  EllipsoidField(const WrapEllipsoid& ellipsoid, const SurfaceFrame& from)
      : per_scale(ellipsoid.semi_axes.cwiseAbs2()), scale(per_scale.cwiseInverse()) {
    const double J = scale.cwiseProduct(from.x).squaredNorm() * from.t.cwiseAbs2().dot(scale);
    for (int i = 0; i < 3; ++i) factor[i] = -J * scale[i];
    factor[3] = factor[4] = -scale.prod();
  }
  /// q = Σ weight x²: the solution has its poles where q = 0.
  [[nodiscard]] Vector3d weight() const { return scale.cwiseAbs2(); }

  template <class Number>
  inline __attribute__((always_inline)) void operator()(const Number (&y)[5],
                                                        Number (&s)[5]) const {
    const Number q = y[0] * y[0] + y[1] * y[1] + y[2] * y[2];
    s[0] = s[1] = s[2] = s[3] = s[4] = 1.0 / (q * q);
  }
};

/// κ = -((1 - h²/ρ²)/r + h² cos φ/ρ³), ρ the distance from the axis, h = ρ (t . round), which stays along
/// a geodesic [Clairaut], cos φ = (ρ - R)/r; G = cos φ/(r ρ).
struct TorusField {
  Vector3d per_scale = Vector3d::Ones(), scale = Vector3d::Ones();
  double factor[5] = {1, 1, 1, 1, 1}, R, per_r, hh;

  TorusField(const WrapTorus& torus, const SurfaceFrame& from)
      : R(torus.ring), per_r(1 / torus.tube) {
    const double h = from.x.x() * from.t.y() - from.x.y() * from.t.x();
    hh = h * h;
  }
  /// ρ² = Σ weight x².
  [[nodiscard]] Vector3d weight() const { return {1, 1, 0}; }

  template <class Number>
  inline __attribute__((always_inline)) void operator()(const Number (&y)[5],
                                                        Number (&s)[5]) const {
    const Number rr = y[0] * y[0] + y[1] * y[1], per_rho = inverse_root(rr);
    const Number out = (rr * per_rho - R) * per_r, tilt = hh * per_rho * per_rho;
    const Number kn = (((tilt - 1.0) * per_r) - tilt * out * per_rho) * per_r;
    s[0] = s[1] = kn * (1.0 - R * per_rho);
    s[2] = kn;
    s[3] = s[4] = -out * per_r * per_rho;
  }
};

/// What a step may lose of surface and Wronskian, and the longest steps [1/rate] that lose no more, by
/// columns: measured on random ellipsoids and tori.
constexpr double kOffSurface = 5e-13, kReach4 = 0.1, kReach6 = 0.3, kReach7 = 0.4, kReach8 = 0.55;

template <class Field>
inline __attribute__((always_inline)) void step_with(
    const Field& field, double h, double reach, const GeodesicState& from, GeodesicState& to) {
  if (reach <= kReach4)
    nystrom::step<4>(field, h, from, to);
  else if (reach <= kReach6)
    nystrom::step<6>(field, h, from, to);
  else if (reach <= kReach7)
    nystrom::step<7>(field, h, from, to);
  else
    nystrom::step<8>(field, h, from, to);
}
// What has a second body is no template.
CONDYLE_FMA_CLONE __attribute__((noinline)) void step(const EllipsoidField& field,
                                                      double h,
                                                      double reach,
                                                      const GeodesicState& from,
                                                      GeodesicState& to) {
  step_with(field, h, reach, from, to);
}
CONDYLE_FMA_CLONE __attribute__((noinline)) void step(
    const TorusField& field, double h, double reach, const GeodesicState& from, GeodesicState& to) {
  step_with(field, h, reach, from, to);
}

/// Squared [1/mm²], of how fast the solution changes: how near along the arc, as a complex number, the
/// next zero of q is, with q'' as it is here, and by how much the surface is curved.
double squared_rate(const Vector3d& weight, const SurfaceFrame& from) {
  const Vector3d qx = weight.cwiseProduct(from.x);
  const double q = qx.dot(from.x), half_slope = qx.dot(from.t);
  const double half_bend = weight.dot(from.t.cwiseAbs2()) + from.kappa * qx.dot(from.n);
  const double root = half_slope * half_slope - q * half_bend;
  const double curved = 0.4 * (std::abs(from.kappa) + std::abs(from.kappa_b));
  const double zero = std::abs(half_slope) + std::sqrt(std::max(0.0, root));
  return (root < 0 ? half_bend / q : zero * zero / (q * q)) + curved * curved;
}

/// How far a point is off the surface, in parts of the least radius.
double off_surface(const WrapEllipsoid& ellipsoid, const Vector3d& x) {
  return x.cwiseQuotient(ellipsoid.semi_axes).squaredNorm() - 1;
}
double off_surface(const WrapTorus& torus, const Vector3d& x) {
  return Eigen::Vector2d(x.head<2>().norm() - torus.ring, x.z()).norm() / torus.tube - 1;
}

thread_local long steps_of_thread = 0;

/// A geodesic from a frame, with a and r, followed in steps that are halved where one loses the surface or
/// the Wronskian a r' - a' r = 1.
template <class Solid, class Field>
class Walk {
 public:
  Walk(const Solid& solid, const SurfaceFrame& from)
      : solid_(solid),
        field_(solid, from),
        rate_(std::sqrt(squared_rate(field_.weight(), from))),
        off_(off_surface(solid, from.x)) {
    const Vector3d y = field_.scale.cwiseProduct(from.x), v = field_.scale.cwiseProduct(from.t),
                   f = from.kappa * field_.scale.cwiseProduct(from.n);
    at_ = {{y.x(), y.y(), y.z(), 1, 0},
           {v.x(), v.y(), v.z(), 0, 1},
           {f.x(), f.y(), f.z(), from.tau * from.tau - from.kappa * from.kappa_b, 0}};
  }

  /// On by `arc`; `passed` is called step by step. False where it gave up.
  template <class Passed>
  bool go(double arc, const Passed& passed) {
    constexpr int kMostSteps = 400;
    double left = arc;
    for (int steps = 0; std::abs(left) > 0; ++steps) {
      ++steps_of_thread;
      if (steps == kMostSteps) return false;
      const double reach = std::abs(left) * rate_;
      const bool last = reach <= kReach8;
      const double h = last ? left : left / std::ceil(reach / kReach8);
      if (!has_f_) tell_f();
      GeodesicState next;
      step(field_, h, std::abs(h) * rate_, at_, next);
      const double off = off_surface(solid_, place_of(next.y)), wronskian = wronskian_of(next);
      if (!(std::abs(off - off_) < kOffSurface) ||
          !(std::abs(wronskian - wronskian_of(at_)) < kOffSurface)) {
        rate_ = 2 * std::max(rate_, 0.5 * kReach4 / std::abs(h));
        continue;
      }
      at_ = next;
      off_ = off;
      left = last ? 0 : left - h;
      has_f_ = false;
      passed();
    }
    return true;
  }
  [[nodiscard]] Vector3d x() const { return place_of(at_.y); }
  [[nodiscard]] Vector3d t() const { return place_of(at_.v); }
  [[nodiscard]] const GeodesicState& at() const { return at_; }

 private:
  void tell_f() {
    double s[5];
    field_(at_.y, s);
    for (int i = 0; i < 5; ++i) at_.f[i] = s[i] * field_.factor[i] * at_.y[i];
    has_f_ = true;
  }
  [[nodiscard]] Vector3d place_of(const double* y) const {
    return Vector3d(y[0], y[1], y[2]).cwiseProduct(field_.per_scale);
  }
  [[nodiscard]] static double wronskian_of(const GeodesicState& s) {
    return s.y[3] * s.v[4] - s.v[3] * s.y[4];
  }

  const Solid& solid_;
  Field field_;
  double rate_;  ///< [1/mm]
  GeodesicState at_;
  bool has_f_ = true;  ///< of at_
  double off_;
};

template <class Solid>
using Field = std::conditional_t<std::is_same_v<Solid, WrapTorus>, TorusField, EllipsoidField>;

template <class Solid>
Geodesic integrate(const Solid& solid,
                   const WrapShape& shape,
                   const SurfaceFrame& from,
                   double arc) {
  Walk<Solid, Field<Solid>> walk(solid, from);
  const GeodesicState& at = walk.at();
  Geodesic g;
  g.from = from;
  g.presses = from.kappa < 0;
  g.found = walk.go(arc, [&] {
    if (at.y[4] * arc <= 0) g.first_of_kind = false;
    // Of normal curvatures only a torus has any but negative ones.
    if constexpr (std::is_same_v<Solid, WrapTorus>)
      g.presses = g.presses && frame_at(shape, walk.x(), walk.t()).kappa < 0;
  });
  g.to = frame_along(shape, walk.x(), walk.t());
  g.a = at.y[3];
  g.r = at.y[4];
  g.da = at.v[3];
  g.dr = at.v[4];
  return g;
}

Geodesic shoot_on(const WrapEllipsoid& solid,
                  const WrapShape& shape,
                  const SurfaceFrame& from,
                  double arc) {
  return integrate(solid, shape, from, arc);
}
Geodesic shoot_on(const WrapTorus& solid,
                  const WrapShape& shape,
                  const SurfaceFrame& from,
                  double arc) {
  return integrate(solid, shape, from, arc);
}

template <class Solid>
void add_steps(const Solid& solid,
               const SurfaceFrame& from,
               double piece,
               int pieces,
               const RigidTransform& X,
               std::vector<Vector3d>& points) {
  Walk<Solid, Field<Solid>> walk(solid, from);
  for (int k = 0; k < pieces && walk.go(piece, [] {}); ++k) points.push_back(X * walk.x());
}

}  // namespace

long geodesic_steps() { return steps_of_thread; }

void add_points_along(const WrapShape& shape,
                      const SurfaceFrame& from,
                      double arc,
                      int pieces,
                      const RigidTransform& X,
                      std::vector<Vector3d>& points) {
  const double piece = arc / pieces;
  if (const auto* ellipsoid = std::get_if<WrapEllipsoid>(&shape))
    return add_steps(*ellipsoid, from, piece, pieces, X, points);
  if (const auto* torus = std::get_if<WrapTorus>(&shape))
    return add_steps(*torus, from, piece, pieces, X, points);
  for (int k = 1; k <= pieces; ++k) points.push_back(X * shoot(shape, from, k * piece).to.x);
}

Geodesic shoot(const WrapShape& shape, const SurfaceFrame& from, double arc) {
  ++steps_of_thread;
  Geodesic g = std::visit([&](const auto& s) { return shoot_on(s, shape, from, arc); }, shape);
  g.arc = arc;
  return g;
}

}  // namespace condyle
