#include "condyle/design/permutation.h"

#include <cmath>

#include "condyle/design/random_bits.h"
#include "condyle/design/uniform_draws.h"

namespace condyle {

namespace {

/// The finaliser of SplitMix64 [Steele 2014]: every bit of x decides about every bit of the result.
std::uint64_t mixed(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

}  // namespace

Permutation::Permutation(std::uint64_t n, std::uint64_t seed, std::uint64_t which) : n_(n) {
  b_ = static_cast<std::uint64_t>(std::ceil(std::sqrt(static_cast<double>(n))));
  a_ = (n + b_ - 1) / b_;
  const auto what = static_cast<std::uint64_t>(UniformFor::kPermutation);
  for (std::size_t i = 0; i < keys_.size(); i += 4) {
    const auto bits = random_bits({i / 4, which, 1, 0}, {seed, what});
    for (std::size_t c = 0; c < 4; ++c) keys_[i + c] = bits[c];
  }
}

std::uint64_t Permutation::once(std::uint64_t k) const {
  std::uint64_t left = k / b_, right = k % b_;
  for (std::size_t i = 0; i < keys_.size(); i += 2) {
    left = (left + mixed(right ^ keys_[i]) % a_) % a_;
    right = (right + mixed(left ^ keys_[i + 1]) % b_) % b_;
  }
  return left * b_ + right;
}

std::uint64_t Permutation::operator()(std::uint64_t k) const {
  do k = once(k);
  while (k >= n_);
  return k;
}

}  // namespace condyle
