#pragma once

/// One step of y'' = f(y), y = (x, a, r): a point that runs along a geodesic, with its two Jacobi
/// fields. Störmer's rule with h/1 .. h/n, extrapolated to h = 0: order 2n, the global errors being
/// even in h [Hairer 1993, II.14]. Four of them run side by side. Only for .cpp files.

#include <algorithm>

#include "condyle/math/simd.h"

namespace condyle {

/// (x, y, z, a, r), their derivatives along the arc, and f there.
struct GeodesicState {
  static constexpr int kSize = 5;
  double y[kSize], v[kSize], f[kSize];
};

namespace nystrom {

inline constexpr int kSize = GeodesicState::kSize;

/// Π_{k≠n} n²/(n² - k²) over k = 1..columns.
constexpr double weight(int columns, int n) {
  double w = 1;
  for (int k = 1; k <= columns; ++k)
    if (k != n) w *= static_cast<double>(n * n) / (n * n - k * k);
  return w;
}

struct Sums {
  Four u[kSize] = {}, v[kSize] = {};
};

/// The lanes run with first, first - 1, first - 2 and first - 3 steps; what each reaches at h counts.
/// f is told as f_i = factor_i s_i y_i, so that little has to wait for s, which takes a division.
template <int columns, int first, class Field>
inline __attribute__((always_inline)) void add_lanes(const Field& field,
                                                     double h,
                                                     const GeodesicState& from,
                                                     Sums& sums) {
  const Four n = {first, std::max(1, first - 1), std::max(1, first - 2), std::max(1, first - 3)};
  const Four H = h * (1 / n), half = 0.5 * H, HH = H * H, per_H = (1 / h) * n;
  Four u[kSize], d[kSize], y[kSize], s[kSize];
#pragma GCC unroll 8
  for (int i = 0; i < kSize; ++i) {
    u[i] = d[i] = H * (from.v[i] + half * from.f[i]);
    y[i] = from.y[i] + u[i];
  }
#pragma GCC unroll 8
  for (int k = 1; k <= first; ++k) {
    field(y, s);
    if (k >= first - 3) {
      Four w = {0, 0, 0, 0};
      w[first - k] = weight(columns, k);
      const Four w_d = w * per_H, w_f = w * half;
#pragma GCC unroll 8
      for (int i = 0; i < kSize; ++i) {
        sums.u[i] += w * u[i];
        sums.v[i] += w_d * d[i];
        sums.v[i] += s[i] * (w_f * field.factor[i] * y[i]);
      }
    }
    if (k == first) break;
#pragma GCC unroll 8
    for (int i = 0; i < kSize; ++i) {
      d[i] += s[i] * (HH * field.factor[i] * y[i]);
      u[i] += d[i];
      y[i] += d[i];
    }
  }
}

inline __attribute__((always_inline)) double sum(const Four& v) {
  return (v[0] + v[1]) + (v[2] + v[3]);
}

/// Of order 2 columns, 4 to 8 of them. f is not told of the new state.
template <int columns, class Field>
inline __attribute__((always_inline)) void step(const Field& field,
                                                double h,
                                                const GeodesicState& from,
                                                GeodesicState& to) {
  Sums sums;
  add_lanes<columns, columns>(field, h, from, sums);
  if constexpr (columns > 4) add_lanes<columns, columns - 4>(field, h, from, sums);
  for (int i = 0; i < kSize; ++i) {
    to.y[i] = from.y[i] + sum(sums.u[i]);
    to.v[i] = sum(sums.v[i]);
  }
}

}  // namespace nystrom
}  // namespace condyle
