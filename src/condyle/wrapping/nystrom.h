#pragma once

/// One step of y'' = f(y), y = (x, a, r): a point that runs along a geodesic, with its two Jacobi
/// fields, or y = x alone. Störmer's rule with h/1 .. h/6, extrapolated to h = 0: order 12, the
/// global errors being even in h [Hairer 1993, II.14]. Four of them run side by side. Only for .cpp
/// files.

#include <algorithm>

#include "condyle/math/simd.h"

namespace condyle {

/// (x, y, z, a, r) or (x, y, z), and their derivatives along the arc.
template <int n>
struct GeodesicState {
  double y[n], v[n];
};

namespace nystrom {

inline constexpr int kMost = 6;  ///< steps of the finest

/// Π_{k≠n} n²/(n² - k²) over k = 1..kMost.
constexpr double weight(int n) {
  double w = 1;
  for (int k = 1; k <= kMost; ++k)
    if (k != n) w *= static_cast<double>(n * n) / (n * n - k * k);
  return w;
}

/// The lanes run with first, first - 1, first - 2 and first - 3 steps; what each reaches at h counts.
template <int first, int size, class Field>
inline __attribute__((always_inline)) void add_lanes(const Field& field,
                                                     double h,
                                                     const GeodesicState<size>& from,
                                                     const double (&f0)[size],
                                                     Four (&u_sum)[size],
                                                     Four (&v_sum)[size]) {
  const Four n = {first, std::max(1, first - 1), std::max(1, first - 2), std::max(1, first - 3)};
  const Four H = h / n, half = 0.5 * H, HH = H * H, per_H = n / h;
  Four u[size], d[size];
  for (int i = 0; i < size; ++i) u[i] = d[i] = H * (from.v[i] + half * f0[i]);
#pragma GCC unroll 8
  for (int k = 1; k <= first; ++k) {
    Four y[size], f[size];
    for (int i = 0; i < size; ++i) y[i] = from.y[i] + u[i];
    field(y, f);
    if (k >= first - 3) {
      Four w = {0, 0, 0, 0};
      w[first - k] = weight(k);
      for (int i = 0; i < size; ++i) {
        u_sum[i] += w * u[i];
        v_sum[i] += w * (per_H * d[i] + half * f[i]);
      }
    }
    for (int i = 0; i < size; ++i) {
      d[i] += HH * f[i];
      u[i] += d[i];
    }
  }
}

inline __attribute__((always_inline)) double sum(const Four& v) {
  return (v[0] + v[1]) + (v[2] + v[3]);
}

template <int size, class Field>
inline __attribute__((always_inline)) void step(const Field& field,
                                                double h,
                                                GeodesicState<size>& s) {
  Four y[size], f[size], u[size] = {}, v[size] = {};
  for (int i = 0; i < size; ++i) y[i] = s.y[i] - Four{};
  field(y, f);
  double f0[size];
  for (int i = 0; i < size; ++i) f0[i] = f[i][0];
  add_lanes<kMost>(field, h, s, f0, u, v);
  add_lanes<kMost - 4>(field, h, s, f0, u, v);
  for (int i = 0; i < size; ++i) {
    s.y[i] += sum(u[i]);
    s.v[i] = sum(v[i]);
  }
}

}  // namespace nystrom
}  // namespace condyle
