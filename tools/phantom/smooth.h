#pragma once

/// Smooth building bricks of the implicit shapes, for double and Jet alike. All are infinitely
/// differentiable.

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "phantom/jet.h"

namespace condyle::phantom {

template <class T>
T square(const T& a) {
  return a * a;
}

/// max(a_i) rounded over a width h: h log Σ exp(a_i/h).
template <class T>
T smooth_max(std::initializer_list<T> terms, double h) {
  double top = value_of(*terms.begin());
  for (const T& a : terms) top = std::max(top, value_of(a));
  using std::exp;
  using std::log;
  T sum(0.0);
  for (const T& a : terms) sum += exp((a - top) * (1 / h));
  return top + h * log(sum);
}

/// min(a_i) rounded over a width h.
template <class T>
T smooth_min(std::initializer_list<T> terms, double h) {
  double bottom = value_of(*terms.begin());
  for (const T& a : terms) bottom = std::min(bottom, value_of(a));
  using std::exp;
  using std::log;
  T sum(0.0);
  for (const T& a : terms) sum += exp((bottom - a) * (1 / h));
  return bottom - h * log(sum);
}

/// max(a, 0) rounded over a width w.
template <class T>
T ramp(const T& a, double w) {
  return smooth_max<T>({a, T(0.0)}, w);
}

/// 0 far below a = 0, 1 far above it, over a width w.
template <class T>
T step(const T& a, double w) {
  using std::exp;
  if (value_of(a) > 0) return 1.0 / (1.0 + exp(a * (-1 / w)));
  const T e = exp(a * (1 / w));
  return e / (1.0 + e);
}

/// a²/2R near a = 0, levelling off beyond |a| = reach at reach²/2R.
template <class T>
T dish(const T& a, double radius, double reach) {
  using std::sqrt;
  const T q = square(a / reach);
  return square(a) * (0.5 / radius) / sqrt(1.0 + square(q));
}

/// A hill of height 1 at (a, b) = (0, 0).
template <class T>
T hill(const T& a, double width_a, const T& b, double width_b) {
  using std::exp;
  return exp(-0.5 * (square(a / width_a) + square(b / width_b)));
}

/// Roughly the distance to the ellipse or ellipsoid with the given semi-axes; negative inside.
template <class T>
T ellipsoid(const T& x, const T& y, const T& z, double a, double b, double c) {
  using std::sqrt;
  const T k0 = sqrt(square(x / a) + square(y / b) + square(z / c) + 1e-4);
  const T k1 = sqrt(square(x / (a * a)) + square(y / (b * b)) + square(z / (c * c)) + 1e-6);
  return k0 * (k0 - 1.0) / k1;
}

}  // namespace condyle::phantom
