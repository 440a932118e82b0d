#pragma once

/// A pseudo-random permutation of 0 ... n-1 whose values are computed one by one, in any order and
/// without a table: a generalised Feistel network on Z_a x Z_b, ab >= n, with cycle walking
/// [Black 2002], its round functions keyed by Philox.

#include <array>
#include <cstdint>

namespace condyle {

class Permutation {
 public:
  /// 1 <= n <= 2^53.
  Permutation(std::uint64_t n, std::uint64_t seed, std::uint64_t which);

  /// Where k < n goes. Threads may ask at the same time.
  [[nodiscard]] std::uint64_t operator()(std::uint64_t k) const;

 private:
  [[nodiscard]] std::uint64_t once(std::uint64_t k) const;

  std::uint64_t n_, a_, b_;  ///< (a - 1) b < n <= ab: a walk is short
  std::array<std::uint64_t, 8> keys_;
};

}  // namespace condyle
