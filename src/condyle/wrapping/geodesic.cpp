#include "condyle/wrapping/geodesic.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

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

/// x'' = -J D x/q², q = |Dx|²: J = q tᵀDt stays along a geodesic [Joachimsthal]. G = det D/q².
struct EllipsoidField {
  double D2[3], JD[3], det;

  EllipsoidField(const WrapEllipsoid& ellipsoid, const SurfaceFrame& from) {
    const Vector3d D = ellipsoid.semi_axes.cwiseAbs2().cwiseInverse();
    const double q = D.cwiseProduct(from.x).squaredNorm();
    const double J = q * from.t.cwiseAbs2().dot(D);
    for (int i = 0; i < 3; ++i) {
      D2[i] = D[i] * D[i];
      JD[i] = -J * D[i];
    }
    det = -D.prod();
  }
  template <int n>
  inline __attribute__((always_inline)) void operator()(const Four (&y)[n], Four (&f)[n]) const {
    const Four q = D2[0] * y[0] * y[0] + D2[1] * y[1] * y[1] + D2[2] * y[2] * y[2];
    const Four w = 1.0 / (q * q), G = det * w;
    for (int i = 0; i < 3; ++i) f[i] = JD[i] * w * y[i];
    for (int i = 3; i < n; ++i) f[i] = G * y[i];
  }
};

/// κ = -((1 - h²/ρ²)/r + h² cos φ/ρ³), ρ the distance from the axis, h = ρ (t . round), which stays along
/// a geodesic [Clairaut], cos φ = (ρ - R)/r; G = cos φ/(r ρ).
struct TorusField {
  double R, per_r, hh;

  TorusField(const WrapTorus& torus, const SurfaceFrame& from)
      : R(torus.ring), per_r(1 / torus.tube) {
    const double h = from.x.x() * from.t.y() - from.x.y() * from.t.x();
    hh = h * h;
  }
  template <int n>
  inline __attribute__((always_inline)) void operator()(const Four (&y)[n], Four (&f)[n]) const {
    const Four rr = y[0] * y[0] + y[1] * y[1];
    const Four per_rho = {1 / std::sqrt(rr[0]), 1 / std::sqrt(rr[1]), 1 / std::sqrt(rr[2]),
                          1 / std::sqrt(rr[3])};
    const Four out = (rr * per_rho - R) * per_r, tilt = hh * per_rho * per_rho;
    const Four kn = (((tilt - 1.0) * per_r) - tilt * out * per_rho) * per_r;
    const Four inwards = kn * (1.0 - R * per_rho), G = -out * per_r * per_rho;
    f[0] = inwards * y[0];
    f[1] = inwards * y[1];
    f[2] = kn * y[2];
    for (int i = 3; i < n; ++i) f[i] = G * y[i];
  }
};

using WithFields = GeodesicState<5>;
using PointAlone = GeodesicState<3>;

CONDYLE_FMA_CLONE __attribute__((noinline)) void step(const EllipsoidField& field,
                                                      double h,
                                                      WithFields& s) {
  nystrom::step(field, h, s);
}
CONDYLE_FMA_CLONE __attribute__((noinline)) void step(const TorusField& field,
                                                      double h,
                                                      WithFields& s) {
  nystrom::step(field, h, s);
}
CONDYLE_FMA_CLONE __attribute__((noinline)) void step(const EllipsoidField& field,
                                                      double h,
                                                      PointAlone& s) {
  nystrom::step(field, h, s);
}
CONDYLE_FMA_CLONE __attribute__((noinline)) void step(const TorusField& field,
                                                      double h,
                                                      PointAlone& s) {
  nystrom::step(field, h, s);
}

/// How far the state is off the surface, in parts of the least radius.
template <int n>
double off_surface(const WrapEllipsoid& ellipsoid, const GeodesicState<n>& s) {
  double level = -1;
  for (int i = 0; i < 3; ++i) {
    const double q = s.y[i] / ellipsoid.semi_axes[i];
    level += q * q;
  }
  return level;
}
template <int n>
double off_surface(const WrapTorus& torus, const GeodesicState<n>& s) {
  return std::hypot(std::hypot(s.y[0], s.y[1]) - torus.ring, s.y[2]) / torus.tube - 1;
}

/// Of the normal curvature κ, only a torus has any but negative ones.
bool presses(const WrapEllipsoid&, const WrapShape&, const WithFields&) { return true; }
bool presses(const WrapTorus&, const WrapShape& shape, const WithFields& s) {
  return frame_at(shape, {s.y[0], s.y[1], s.y[2]}, {s.v[0], s.v[1], s.v[2]}).kappa < 0;
}

constexpr double kOffSurface = 5e-13;

/// Steps that turn by 0.5 rad at most where they begin, halved where one loses the surface or the
/// Wronskian a r' - a' r = 1.
template <class Field, class Shape>
Geodesic integrate(const Shape& solid,
                   const WrapShape& shape,
                   const SurfaceFrame& from,
                   double arc) {
  constexpr double kTurn = 0.5;
  constexpr int kMostSteps = 400;
  const Field field(solid, from);
  WithFields at = {{from.x.x(), from.x.y(), from.x.z(), 1, 0},
                   {from.t.x(), from.t.y(), from.t.z(), 0, 1}};
  Geodesic g;
  g.from = from;
  g.presses = from.kappa < 0;
  double left = arc, longest = kTurn / largest_curvature(from);
  double last_off = off_surface(solid, at), last_wronskian = 1;
  int steps = 0;
  for (; std::abs(left) > 0 && steps < kMostSteps; ++steps) {
    const double pieces = std::ceil(std::abs(left) / longest - 1e-6),
                 h = left / std::max(1.0, pieces);
    WithFields next = at;
    step(field, h, next);
    const double off = off_surface(solid, next),
                 wronskian = next.y[3] * next.v[4] - next.v[3] * next.y[4];
    if (!(std::abs(off - last_off) < kOffSurface) ||
        !(std::abs(wronskian - last_wronskian) < kOffSurface)) {
      longest = 0.5 * std::abs(h);
      continue;
    }
    if (next.y[4] * arc <= 0) g.first_of_kind = false;
    g.presses = g.presses && presses(solid, shape, next);
    at = next;
    last_off = off;
    last_wronskian = wronskian;
    left = pieces > 1 ? left - h : 0;
  }
  g.found = steps < kMostSteps;
  const Vector3d x(at.y[0], at.y[1], at.y[2]), t(at.v[0], at.v[1], at.v[2]);
  g.to = frame_at(shape, x, t);
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
  return integrate<EllipsoidField>(solid, shape, from, arc);
}
Geodesic shoot_on(const WrapTorus& solid,
                  const WrapShape& shape,
                  const SurfaceFrame& from,
                  double arc) {
  return integrate<TorusField>(solid, shape, from, arc);
}

/// One step, or as many halves as keep it on the surface.
template <class Field, class Shape>
void advance(const Field& field, const Shape& solid, double h, int halvings, PointAlone& at) {
  PointAlone next = at;
  step(field, h, next);
  const double off = std::abs(off_surface(solid, next) - off_surface(solid, at));
  if (off < kOffSurface || halvings == 0) {
    at = next;
    return;
  }
  advance(field, solid, h / 2, halvings - 1, at);
  advance(field, solid, h / 2, halvings - 1, at);
}

template <class Field, class Shape>
void add_steps(const Shape& solid,
               const SurfaceFrame& from,
               double piece,
               int pieces,
               const RigidTransform& X,
               std::vector<Vector3d>& points) {
  constexpr int kMostHalvings = 8;
  const Field field(solid, from);
  PointAlone at = {{from.x.x(), from.x.y(), from.x.z()}, {from.t.x(), from.t.y(), from.t.z()}};
  for (int k = 0; k < pieces; ++k) {
    advance(field, solid, piece, kMostHalvings, at);
    points.push_back(X * Vector3d(at.y[0], at.y[1], at.y[2]));
  }
}

}  // namespace

void add_points_along(const WrapShape& shape,
                      const SurfaceFrame& from,
                      double arc,
                      int pieces,
                      const RigidTransform& X,
                      std::vector<Vector3d>& points) {
  const double piece = arc / pieces;
  if (const auto* ellipsoid = std::get_if<WrapEllipsoid>(&shape))
    return add_steps<EllipsoidField>(*ellipsoid, from, piece, pieces, X, points);
  if (const auto* torus = std::get_if<WrapTorus>(&shape))
    return add_steps<TorusField>(*torus, from, piece, pieces, X, points);
  for (int k = 1; k <= pieces; ++k) points.push_back(X * shoot(shape, from, k * piece).to.x);
}

Geodesic shoot(const WrapShape& shape, const SurfaceFrame& from, double arc) {
  Geodesic g = std::visit([&](const auto& s) { return shoot_on(s, shape, from, arc); }, shape);
  g.arc = arc;
  return g;
}

}  // namespace condyle
