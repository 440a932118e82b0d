#pragma once

/// Independent numbers of the open unit interval, each a function of where it stands: Philox4x64
/// [Salmon 2011], 53 bits.

#include <cstdint>
#include <vector>

namespace condyle {

/// `what`: what the draws are for (DrawsFor of normal_draws.h).
void uniform_draws(std::uint64_t seed,
                   std::uint64_t what,
                   std::uint64_t sample,
                   std::vector<double>& u);

}  // namespace condyle
