#pragma once

/// A number that carries its exact gradient and Hessian with respect to three coordinates, so that
/// an implicit shape written once as a formula also yields its normals and curvatures.

#include <Eigen/Core>

#include <cmath>

namespace condyle::phantom {

struct Jet {
  double v = 0;                                 ///< value
  Eigen::Vector3d g = Eigen::Vector3d::Zero();  ///< gradient
  Eigen::Matrix3d h = Eigen::Matrix3d::Zero();  ///< Hessian

  Jet() = default;
  explicit Jet(double value) : v(value) {}
  /// The coordinate number `axis` at `value`.
  static Jet coordinate(double value, int axis) {
    Jet jet(value);
    jet.g[axis] = 1;
    return jet;
  }
};

/// φ(a) from φ, φ', φ'' at a.v.
inline Jet chain(const Jet& a, double value, double first, double second) {
  Jet r(value);
  r.g = first * a.g;
  r.h = first * a.h + second * a.g * a.g.transpose();
  return r;
}

inline Jet operator+(const Jet& a, const Jet& b) {
  Jet r(a.v + b.v);
  r.g = a.g + b.g;
  r.h = a.h + b.h;
  return r;
}
inline Jet operator-(const Jet& a, const Jet& b) {
  Jet r(a.v - b.v);
  r.g = a.g - b.g;
  r.h = a.h - b.h;
  return r;
}
inline Jet operator*(const Jet& a, const Jet& b) {
  Jet r(a.v * b.v);
  r.g = a.v * b.g + b.v * a.g;
  r.h = a.v * b.h + b.v * a.h + a.g * b.g.transpose() + b.g * a.g.transpose();
  return r;
}

inline Jet operator+(const Jet& a, double b) {
  Jet r = a;
  r.v += b;
  return r;
}
inline Jet operator+(double a, const Jet& b) { return b + a; }
inline Jet operator-(const Jet& a, double b) { return a + (-b); }
inline Jet operator-(double a, const Jet& b) { return chain(b, a - b.v, -1, 0); }
inline Jet operator*(double a, const Jet& b) { return chain(b, a * b.v, a, 0); }
inline Jet operator*(const Jet& a, double b) { return b * a; }
inline Jet operator/(const Jet& a, double b) { return (1 / b) * a; }
inline Jet operator/(double a, const Jet& b) {
  return chain(b, a / b.v, -a / (b.v * b.v), 2 * a / (b.v * b.v * b.v));
}

inline Jet operator/(const Jet& a, const Jet& b) { return a * (1.0 / b); }
inline Jet& operator+=(Jet& a, const Jet& b) { return a = a + b; }

inline Jet sqrt(const Jet& a) {
  const double s = std::sqrt(a.v);
  return chain(a, s, 0.5 / s, -0.25 / (s * a.v));
}
inline Jet exp(const Jet& a) {
  const double e = std::exp(a.v);
  return chain(a, e, e, e);
}
inline Jet log(const Jet& a) { return chain(a, std::log(a.v), 1 / a.v, -1 / (a.v * a.v)); }
inline Jet sin(const Jet& a) { return chain(a, std::sin(a.v), std::cos(a.v), -std::sin(a.v)); }
inline Jet cos(const Jet& a) { return chain(a, std::cos(a.v), -std::sin(a.v), -std::cos(a.v)); }

/// The angle of the point (x, y), in (-π, π].
inline Jet atan2(const Jet& y, const Jet& x) {
  const double r2 = x.v * x.v + y.v * y.v;
  const double fx = -y.v / r2, fy = x.v / r2;
  const double fxx = 2 * x.v * y.v / (r2 * r2), fxy = (y.v * y.v - x.v * x.v) / (r2 * r2);
  Jet r(std::atan2(y.v, x.v));
  r.g = fx * x.g + fy * y.g;
  r.h = fx * x.h + fy * y.h + fxx * (x.g * x.g.transpose() - y.g * y.g.transpose()) +
        fxy * (x.g * y.g.transpose() + y.g * x.g.transpose());
  return r;
}

inline double value_of(double a) { return a; }
inline double value_of(const Jet& a) { return a.v; }

}  // namespace condyle::phantom
