#pragma once

/// Independent numbers of the open unit interval, each a function of where it stands: Philox4x64
/// [Salmon 2011], odd multiples of 2^-53.

#include <cstdint>
#include <vector>

namespace condyle {

/// What uniform draws are for.
enum class UniformFor : std::uint64_t {
  kPoint = 1,
  kWithinStratum = 2,
  kShift = 3,
  kPermutation = 4
};

/// Fills u, of any size. `what`: what the draws are for; any number shares no bits with normal_draws,
/// DrawsFor or not. The first numbers do not depend on how many are asked for.
void uniform_draws(std::uint64_t seed,
                   std::uint64_t what,
                   std::uint64_t sample,
                   std::vector<double>& u);

}  // namespace condyle
