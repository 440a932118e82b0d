#include "condyle/wrapping/one_surface.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include "condyle/wrapping/geodesic.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

/// In the plane through the centre: with θ from X to Y, α and β from X to P and from Q to Y, the arc is
/// R (θ - α - β).
OneSurfacePath over(const WrapSphere& sphere,
                    const WrapShape&,
                    const Vector3d& X,
                    const Vector3d& Y,
                    bool anchored,
                    ArcPlace& place,
                    std::optional<ArcEnd>&,
                    double) {
  OneSurfacePath path;
  const double R = sphere.radius, xx = X.squaredNorm(), yy = Y.squaredNorm();
  if (!(anchored || xx > R * R) || !(yy > R * R)) return path;
  const double x = std::sqrt(xx), y = std::sqrt(yy);
  path.l1 = anchored ? 0 : std::sqrt(xx - R * R);
  path.l2 = std::sqrt(yy - R * R);
  Vector3d m = X.cross(Y);
  const double mm = m.norm();
  if (mm > 1e-12 * x * y) {
    m /= mm;
  } else {
    m = place.P.cross(place.t);
    m = (m - m.dot(X) / xx * X).normalized();
    if (!m.allFinite()) m = X.unitOrthogonal();
  }
  const double c = X.dot(Y) / (x * y), s = mm / (x * y);
  const double c_a = R / x, s_a = path.l1 / x, c_b = R / y, s_b = path.l2 / y;
  const double c_ab = c_a * c_b - s_a * s_b, s_ab = s_a * c_b + c_a * s_b;
  const double c_psi = c * c_ab + s * s_ab, s_psi = s * c_ab - c * s_ab;
  const double psi = std::atan2(s_psi, c_psi);
  path.n = c_a / x * X + s_a / x * m.cross(X);
  path.n_Q = c_b / y * Y - s_b / y * m.cross(Y);
  path.e_X = m.cross(path.n);
  path.e_Y = m.cross(path.n_Q);
  path.b = path.b_Q = -m;
  path.A = c_psi - path.l2 * s_psi / R;
  path.D = c_psi - path.l1 * s_psi / R;
  path.B = path.A * path.l1 + R * s_psi + path.l2 * c_psi;
  place = {R * path.n, path.e_X, R * psi};
  path.length = path.l1 + place.arc + path.l2;
  path.found = path.length > 0;
  path.shortest = path.B > 0;
  return path;
}

/// Unrolled, the tangents and the arc are one straight line; seen along the axis it goes round by ψ.
OneSurfacePath over(const WrapCylinder& cylinder,
                    const WrapShape&,
                    const Vector3d& X,
                    const Vector3d& Y,
                    bool anchored,
                    ArcPlace& place,
                    std::optional<ArcEnd>&,
                    double) {
  OneSurfacePath path;
  const double R = cylinder.radius;
  const double xx = X.x() * X.x() + X.y() * X.y(), yy = Y.x() * Y.x() + Y.y() * Y.y();
  if (!(anchored || xx > R * R) || !(yy > R * R)) return path;
  const double l1 = anchored ? 0 : std::sqrt(xx - R * R), l2 = std::sqrt(yy - R * R);
  const double sense = place.P.x() * place.t.y() - place.P.y() * place.t.x() < 0 ? -1 : 1;
  const double kept = place.arc * std::hypot(place.t.x(), place.t.y()) / R;
  const double l1_s = sense * l1, l2_s = -sense * l2;
  path.n = Vector3d(R * X.x() - l1_s * X.y(), l1_s * X.x() + R * X.y(), 0) / xx;
  path.n_Q = Vector3d(R * Y.x() - l2_s * Y.y(), l2_s * Y.x() + R * Y.y(), 0) / yy;
  double psi = sense * std::atan2(path.n.x() * path.n_Q.y() - path.n.y() * path.n_Q.x(),
                                  path.n.x() * path.n_Q.x() + path.n.y() * path.n_Q.y());
  psi += 2 * M_PI * std::round((kept - psi) / (2 * M_PI));
  const double flat = l1 + R * psi + l2, z = Y.z() - X.z(), L = std::sqrt(flat * flat + z * z);
  if (!(flat > 0)) return path;
  const double c = flat / L, s = z / L;
  path.e_X = Vector3d(-sense * c * path.n.y(), sense * c * path.n.x(), s);
  path.e_Y = Vector3d(-sense * c * path.n_Q.y(), sense * c * path.n_Q.x(), s);
  path.b = path.e_X.cross(path.n);
  path.b_Q = path.e_Y.cross(path.n_Q);
  path.l1 = l1 / c;
  path.l2 = l2 / c;
  path.A = path.D = 1;
  path.B = path.length = L;
  place.P = R * path.n;
  place.P.z() = X.z() + s * path.l1;
  place.t = path.e_X;
  place.arc = R * psi / c;
  path.found = path.shortest = true;
  return path;
}

Geodesic geodesic_between(const WrapShape& shape, const SurfaceFrame& start, const ArcEnd& end) {
  Geodesic g;
  g.from = start;
  g.to = frame_at(shape, end.Q, end.t);
  g.a = end.a;
  g.da = end.da;
  g.r = end.r;
  g.dr = end.dr;
  return g;
}

/// To first order a frame whose point moves on the surface by `ahead` along t and `aside` along b, while t
/// turns towards b.
SurfaceFrame moved(const SurfaceFrame& f, double ahead, double aside, double turn) {
  const double nod = f.kappa * ahead + f.tau * aside, roll = f.tau * ahead + f.kappa_b * aside;
  SurfaceFrame m = f;
  m.x += ahead * f.t + aside * f.b;
  m.t += turn * f.b + nod * f.n;
  m.n -= nod * f.t + roll * f.b;
  m.b += roll * f.n - turn * f.t;
  return m;
}

double gauss_curvature(const SurfaceFrame& f) { return f.kappa * f.kappa_b - f.tau * f.tau; }

/// Where a geodesic ends at `at` that begins `ahead` of g and ends `slide` farther; of the fields, what a
/// small step aside changes is left out.
ArcEnd end_of(const Geodesic& g, const SurfaceFrame& at, double ahead, double slide) {
  const double G = gauss_curvature(g.from) * ahead, G_Q = gauss_curvature(g.to) * slide;
  return {at.x,
          at.t,
          g.a + g.da * slide + G * g.r,
          g.da - G_Q * g.a + G * g.dr,
          g.r + g.dr * slide - ahead * g.a,
          g.dr - G_Q * g.r - ahead * g.da};
}

/// Step (δθ, δb, δt, δℓ) from the path errors; singular only where the path does not press or B = 0.
template <class Solid>
OneSurfacePath over(const Solid&,
                    const WrapShape& shape,
                    const Vector3d& X,
                    const Vector3d& Y,
                    bool anchored,
                    ArcPlace& place,
                    std::optional<ArcEnd>& end,
                    double small) {
  constexpr double kLongest = 0.3, kSame = 1e-11;
  const double same =
      small > kSmallStep ? small : kSame;  // of a first step that follows no geodesic
  constexpr int kMostSteps = 60;
  OneSurfacePath path;
  for (int iteration = 0; iteration < kMostSteps; ++iteration) {
    const SurfaceFrame start = frame_at(shape, place.P, place.t);
    const bool known = iteration == 0 && end;
    const Geodesic g =
        known ? geodesic_between(shape, start, *end) : shoot(shape, start, place.arc);
    if (!g.found || !g.to.x.allFinite()) return path;
    const SurfaceFrame &f = g.from, &f_Q = g.to;
    const Vector3d d1 = f.x - X, d2 = Y - f_Q.x;
    const double l1 = anchored ? 0 : d1.norm(), l2 = d2.norm();
    const double rho1 = anchored ? 0 : d1.dot(f.n) / l1, rho2 = anchored ? 0 : d1.dot(f.b);
    const double rho3 = d2.dot(f_Q.n) / l2, rho4 = d2.dot(f_Q.b);
    const double A = g.a + l2 * g.da;
    double turn = (rho4 + A * rho2) / (A * l1 + g.r + l2 * g.dr);
    double aside = l1 * turn - rho2;
    double ahead = (rho1 - f.tau * aside) / f.kappa;
    double slide = (rho3 - f_Q.tau * (g.a * aside + g.r * turn)) / f_Q.kappa;  // δt + δℓ
    const double k = largest_curvature(f), k_Q = largest_curvature(f_Q);
    const double size = std::max(
        {std::abs(turn), k * std::max(std::abs(aside), std::abs(ahead)), k_Q * std::abs(slide)});
    if (!std::isfinite(size)) return path;
    if (size > kLongest) {
      const double part = kLongest / size;
      turn *= part;
      aside *= part;
      ahead *= part;
      slide *= part;
    }
    const SurfaceFrame at_P = moved(f, ahead, aside, turn);
    if (!anchored) place.P = onto_surface(shape, at_P.x);
    place.t = at_P.t;
    place.arc += slide - ahead;
    if (size > (known ? same : small) || (known && end->size > small)) continue;
    const SurfaceFrame at_Q =
        moved(f_Q, slide, g.a * aside + g.r * turn, g.da * aside + g.dr * turn);
    const double inexact = known ? std::max(size, end->size) : size;
    end = end_of(g, at_Q, ahead, slide);
    end->size = inexact;
    path.l1 = anchored ? 0 : (place.P - X).norm();
    path.l2 = (Y - at_Q.x).norm();
    path.A = end->a + path.l2 * end->da;
    path.B = path.A * path.l1 + end->r + path.l2 * end->dr;
    path.D = end->da * path.l1 + end->dr;
    path.e_X = anchored ? place.t : Vector3d((place.P - X) / path.l1);
    path.e_Y = (Y - at_Q.x) / path.l2;
    path.n = at_P.n;
    path.b = at_P.b;
    path.n_Q = at_Q.n;
    path.b_Q = at_Q.b;
    path.length = path.l1 + place.arc + path.l2;
    path.found = path.e_X.dot(f.t) > 0 && path.e_Y.dot(f_Q.t) > 0;
    path.shortest =
        path.B > 0 && g.presses && (place.arc <= 0 || (g.first_of_kind && l1 * g.a + g.r > 0));
    return path;
  }
  return path;
}

}  // namespace

OneSurfacePath path_over(const WrapShape& shape,
                         const Vector3d& X,
                         const Vector3d& Y,
                         bool anchored,
                         ArcPlace& place,
                         std::optional<ArcEnd>& end,
                         double small) {
  return std::visit(
      [&](const auto& solid) { return over(solid, shape, X, Y, anchored, place, end, small); },
      shape);
}

}  // namespace condyle
