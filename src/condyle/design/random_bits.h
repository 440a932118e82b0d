#pragma once

/// Random bits as a function of a counter and a key: Philox4x64 with ten rounds [Salmon 2011]. The one
/// door to Random123.
///
/// Who draws what: the key is the seed and what the draws are for, the counter is {block, sample, kind
/// of draws, 0}, so that no two kinds of draws share bits.

#include <array>
#include <cstdint>

namespace condyle {

[[nodiscard]] std::array<std::uint64_t, 4> random_bits(
    const std::array<std::uint64_t, 4>& counter,  //
    const std::array<std::uint64_t, 2>& key);

/// The open unit interval from 64 bits: an odd multiple of 2^-53 (u01fixedpt of Random123), so that u
/// and 1 - u are exact and neither is ever 0. Keeps the order of the bits.
[[nodiscard]] double open_unit(std::uint64_t bits);

}  // namespace condyle
