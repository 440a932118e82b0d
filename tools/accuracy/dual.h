#pragma once

/// A number with its derivatives in N directions, for Jacobians of what is written as a template.

#include <Eigen/Core>

#include <cmath>

namespace condyle::accuracy {

template <int N>
struct Dual {
  using Vector = Eigen::Matrix<double, N, 1>;
  double v = 0;
  Vector d = Vector::Zero();

  Dual() = default;
  Dual(double value) : v(value) {}  // NOLINT: numbers turn into duals by themselves
  Dual(double value, const Vector& derivatives) : v(value), d(derivatives) {}
  static Dual variable(double value, int i) { return {value, Vector::Unit(i)}; }

  friend Dual operator+(const Dual& a, const Dual& b) { return {a.v + b.v, a.d + b.d}; }
  friend Dual operator-(const Dual& a, const Dual& b) { return {a.v - b.v, a.d - b.d}; }
  friend Dual operator-(const Dual& a) { return {-a.v, -a.d}; }
  friend Dual operator*(const Dual& a, const Dual& b) { return {a.v * b.v, a.v * b.d + b.v * a.d}; }
  friend Dual operator/(const Dual& a, const Dual& b) {
    return {a.v / b.v, (a.d - a.v / b.v * b.d) / b.v};
  }
  Dual& operator+=(const Dual& b) { return *this = *this + b; }
  Dual& operator-=(const Dual& b) { return *this = *this - b; }
  Dual& operator*=(const Dual& b) { return *this = *this * b; }
  Dual& operator/=(const Dual& b) { return *this = *this / b; }
  friend bool operator<(const Dual& a, const Dual& b) { return a.v < b.v; }
  friend bool operator>(const Dual& a, const Dual& b) { return a.v > b.v; }
  friend Dual sqrt(const Dual& a) {
    const double root = std::sqrt(a.v);
    return {root, a.d / (2 * root)};
  }
  friend Dual atan2(const Dual& y, const Dual& x) {
    return {std::atan2(y.v, x.v), (x.v * y.d - y.v * x.d) / (x.v * x.v + y.v * y.v)};
  }
};

}  // namespace condyle::accuracy

template <int N>
struct Eigen::NumTraits<condyle::accuracy::Dual<N>> : Eigen::NumTraits<double> {
  using Real = condyle::accuracy::Dual<N>;
  using NonInteger = Real;
  using Nested = Real;
  // NOLINTNEXTLINE(readability-identifier-naming) names that Eigen asks for
  enum { IsComplex = 0, IsInteger = 0, RequireInitialization = 1, AddCost = N, MulCost = 3 * N };
};
