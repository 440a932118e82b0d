#pragma once

/// Four numbers at once, and a second body of hot functions for processors with fused multiply-add,
/// chosen when the program starts. Only for .cpp files: nothing of it crosses an interface.

#include <cstring>

namespace condyle {

// The helpers never cross a library's border, so how vectors are passed does not matter.
#pragma GCC diagnostic ignored "-Wpsabi"

/// Two SSE2 registers, or one of AVX where the function is built for it (GCC and Clang).
using Four = double __attribute__((vector_size(32)));

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define CONDYLE_FMA_CLONE __attribute__((target_clones("default", "fma")))
#else
#define CONDYLE_FMA_CLONE
#endif

// Before a loop over coordinates: so that arrays of Four stay in registers. GCC unrolls such loops too late for that.
#if defined(__GNUC__) && !defined(__clang__)
#define CONDYLE_UNROLL _Pragma("GCC unroll 16")
#else
#define CONDYLE_UNROLL
#endif

inline __attribute__((always_inline)) Four load_four(const double* p) {
  Four v;
  std::memcpy(&v, p, sizeof v);
  return v;
}
inline __attribute__((always_inline)) void store_four(double* p, const Four& v) {
  std::memcpy(p, &v, sizeof v);
}

}  // namespace condyle
