#include "condyle/wrapping/shape_geometry.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace condyle {
namespace {

using Eigen::Vector3d;

template <class... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};
template <class... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;

Vector3d across_z(const Vector3d& x) { return {x.x(), x.y(), 0}; }

/// Unit, along the part of x at right angles to z; any such direction where there is none.
Vector3d radial(const Vector3d& x) {
  const double rho = x.head<2>().norm();
  return rho > 0 ? Vector3d(across_z(x) / rho) : Vector3d::UnitX();
}

Vector3d unit_or(const Vector3d& v, const Vector3d& otherwise) {
  const double length = v.norm();
  return length > 0 ? Vector3d(v / length) : otherwise;
}

/// Normal, and -K of tangents as a product with a vector.
struct DiagonalCurvature {
  Vector3d n, minus_K;
  [[nodiscard]] Vector3d of(const Vector3d& t) const { return minus_K.cwiseProduct(t); }
};
struct Curvature {
  Vector3d n;
  Eigen::Matrix3d minus_K;
  [[nodiscard]] Vector3d of(const Vector3d& t) const { return minus_K * t; }
};

DiagonalCurvature curvature_at(const WrapSphere& sphere, const Vector3d& x) {
  return {unit_or(x, Vector3d::UnitZ()), Vector3d::Constant(1 / sphere.radius)};
}
DiagonalCurvature curvature_at(const WrapCylinder& cylinder, const Vector3d& x) {
  const double k = 1 / cylinder.radius;
  return {radial(x), Vector3d(k, k, 0)};
}
DiagonalCurvature curvature_at(const WrapEllipsoid& ellipsoid, const Vector3d& x) {
  const Vector3d D = ellipsoid.semi_axes.cwiseAbs2().cwiseInverse();
  const Vector3d g = D.cwiseProduct(x);
  const double inverse = 1 / g.norm();
  return {g * inverse, inverse * D};
}
Curvature curvature_at(const WrapTorus& torus, const Vector3d& x) {
  const Vector3d out = radial(x), n = unit_or(x - torus.ring * out, out);
  const Vector3d round(-out.y(), out.x(), 0), up = n.cross(round);
  const double rho = std::max(1e-300, torus.ring + torus.tube * n.dot(out));
  return {n, n.dot(out) / rho * round * round.transpose() + up * up.transpose() / torus.tube};
}

template <class CurvatureOf>
SurfaceFrame frame_with(const CurvatureOf& c, const Vector3d& x, const Vector3d& t) {
  SurfaceFrame frame;
  frame.x = x;
  frame.n = c.n;
  frame.t = t;
  frame.b = frame.t.cross(frame.n);
  const Vector3d Kt = c.of(frame.t);
  frame.kappa = -frame.t.dot(Kt);
  frame.tau = -frame.b.dot(Kt);
  frame.kappa_b = -frame.b.dot(c.of(frame.b));
  return frame;
}

template <class CurvatureOf>
SurfaceFrame frame_of(const CurvatureOf& c, const Vector3d& x, const Vector3d& along) {
  return frame_with(c, x, (along - c.n.dot(along) * c.n).normalized());
}

/// t with Σ (a x/(t + a²))² = 1: the closest point is a² x/(t + a²) [Eberly 2013]. Newton from the left on
/// a function that is convex and falls where t > -a_min².
Vector3d closest_on_ellipsoid(const Vector3d& a, const Vector3d& point) {
  int thin = 0;
  const double least = a.minCoeff(&thin);
  Vector3d p = point.cwiseAbs() / least;
  const Vector3d s = a / least, s2 = s.cwiseAbs2();
  Vector3d closest;
  // Near the plane across the shortest axis, inside the focal ellipse: the part leaves the plane.
  double t = -1 + p[thin];
  for (int i = 0; i < 3; ++i) t = std::max(t, s[i] * p[i] - s2[i]);
  const auto excess = [&](double at, double& slope) {
    double f = -1;
    slope = 0;
    for (int i = 0; i < 3; ++i) {
      if (p[i] == 0) continue;
      const double w = at + s2[i], q = s[i] * p[i] / w;
      f += q * q;
      slope -= 2 * q * q / w;
    }
    return f;
  };
  double limit = -1, slope = 0;
  if (!(t > limit) || !(p[thin] > 1e-150)) {
    // p_thin = 0: the root is at -1 where the others leave room for the shortest axis.
    p[thin] = 0;
    double room = 1;
    for (int i = 0; i < 3; ++i)
      if (p[i] > 0 && s2[i] > 1) room -= std::pow(s[i] * p[i] / (s2[i] - 1), 2);
    bool free = room >= 0;
    for (int i = 0; i < 3; ++i) free = free && !(i != thin && s2[i] <= 1 && p[i] > 0);
    if (free) {
      for (int i = 0; i < 3; ++i)
        closest[i] = i == thin ? std::sqrt(room) : s2[i] > 1 ? s2[i] * p[i] / (s2[i] - 1) : 0;
      closest = least * closest;
      for (int i = 0; i < 3; ++i) closest[i] = std::copysign(closest[i], point[i]);
      return closest;
    }
    for (int i = 0; i < 3; ++i)
      if (i != thin) t = std::max(t, s[i] * p[i] - s2[i]);
  }
  for (int k = 0; k < 200; ++k) {
    const double f = excess(t, slope);
    if (!(slope < 0)) break;
    const double next = t - f / slope;
    if (!(next > t)) break;
    t = next;
  }
  for (int i = 0; i < 3; ++i)
    closest[i] = std::copysign(least * s2[i] * p[i] / (t + s2[i]), point[i]);
  return closest;
}

}  // namespace

double largest_curvature(const SurfaceFrame& f) {
  return std::max(std::abs(f.kappa), std::abs(f.kappa_b)) + std::abs(f.tau);
}

SurfaceFrame frame_at(const WrapShape& shape, const Vector3d& x, const Vector3d& along) {
  return std::visit([&](const auto& s) { return frame_of(curvature_at(s, x), x, along); }, shape);
}

SurfaceFrame frame_along(const WrapShape& shape, const Vector3d& x, const Vector3d& t) {
  return std::visit([&](const auto& s) { return frame_with(curvature_at(s, x), x, t); }, shape);
}

Vector3d normal_at(const WrapShape& shape, const Vector3d& x) {
  return std::visit([&](const auto& s) { return curvature_at(s, x).n; }, shape);
}

Vector3d onto_surface(const WrapShape& shape, const Vector3d& x) {
  if (const auto* ellipsoid = std::get_if<WrapEllipsoid>(&shape)) {
    const Vector3d D = ellipsoid->semi_axes.cwiseAbs2().cwiseInverse();
    Vector3d on = x;
    if (const double level = D.dot(x.cwiseAbs2()) / 2; level > 1) on /= std::sqrt(level);
    for (int k = 0; k < 20; ++k) {
      const Vector3d g = D.cwiseProduct(on);
      const double excess = on.dot(g) - 1;
      on -= excess / (2 * g.squaredNorm()) * g;
      if (std::abs(excess) < 1e-8) break;
    }
    return on;
  }
  return closest_point(shape, x);
}

Vector3d closest_point(const WrapShape& shape, const Vector3d& x) {
  return std::visit(
      Overloaded{
          [&](const WrapSphere& s) -> Vector3d { return s.radius * unit_or(x, Vector3d::UnitZ()); },
          [&](const WrapCylinder& c) -> Vector3d {
            return c.radius * radial(x) + x.z() * Vector3d::UnitZ();
          },
          [&](const WrapEllipsoid& e) { return closest_on_ellipsoid(e.semi_axes, x); },
          [&](const WrapTorus& t) -> Vector3d {
            const Vector3d ring = t.ring * radial(x);
            return ring + t.tube * unit_or(x - ring, radial(x));
          }},
      shape);
}

double signed_distance(const WrapShape& shape, const Vector3d& x) {
  return std::visit(
      Overloaded{[&](const WrapSphere& s) { return x.norm() - s.radius; },
                 [&](const WrapCylinder& c) { return x.head<2>().norm() - c.radius; },
                 [&](const WrapEllipsoid& e) {
                   const double distance = (x - closest_on_ellipsoid(e.semi_axes, x)).norm();
                   return x.cwiseQuotient(e.semi_axes).squaredNorm() < 1 ? -distance : distance;
                 },
                 [&](const WrapTorus& t) {
                   return Eigen::Vector2d(x.head<2>().norm() - t.ring, x.z()).norm() - t.tube;
                 }},
      shape);
}

double least_radius(const WrapShape& shape) {
  return std::visit(Overloaded{[](const WrapSphere& s) { return s.radius; },
                               [](const WrapCylinder& c) { return c.radius; },
                               [](const WrapEllipsoid& e) { return e.semi_axes.minCoeff(); },
                               [](const WrapTorus& t) { return t.tube; }},
                    shape);
}

bool has_size(const WrapShape& shape) {
  if (const auto* torus = std::get_if<WrapTorus>(&shape))
    return torus->tube > 0 && torus->ring > torus->tube;
  return least_radius(shape) > 0;
}

}  // namespace condyle
