#pragma once

/// Square roots of four numbers at once (simd.h): std::sqrt would have each tell of an error.

#include <cmath>

#include "condyle/math/simd.h"

namespace condyle {

inline __attribute__((always_inline)) Four sqrt_four(const Four& v) {
#if defined(__SSE2__) && defined(__GNUC__) && !defined(__clang__)
  using Two = double __attribute__((vector_size(16)));
  const Two low = __builtin_ia32_sqrtpd(Two{v[0], v[1]});
  const Two high = __builtin_ia32_sqrtpd(Two{v[2], v[3]});
  const Four roots = {low[0], low[1], high[0], high[1]};
#else
  const Four roots = {std::sqrt(v[0]), std::sqrt(v[1]), std::sqrt(v[2]), std::sqrt(v[3])};
#endif
  return roots;
}

}  // namespace condyle
