#pragma once

/// Square roots of four numbers at once (simd.h): std::sqrt would have each tell of an error.

#include <cmath>

#include "condyle/math/simd.h"

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace condyle {

inline __attribute__((always_inline)) Four sqrt_four(const Four& v) {
#if defined(__SSE2__)
  const __m128d low = _mm_sqrt_pd(__m128d{v[0], v[1]}), high = _mm_sqrt_pd(__m128d{v[2], v[3]});
  const Four roots = {low[0], low[1], high[0], high[1]};
#else
  const Four roots = {std::sqrt(v[0]), std::sqrt(v[1]), std::sqrt(v[2]), std::sqrt(v[3])};
#endif
  return roots;
}

}  // namespace condyle
