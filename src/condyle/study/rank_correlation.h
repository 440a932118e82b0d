#pragma once

/// Spearman's rank correlation of parameters with a quantity, ties by their average rank, over the
/// samples where the quantity is known.

#include <cstdint>
#include <span>
#include <vector>

namespace condyle {

/// Of each value of a sample, which of the distinct values it is, from below.
struct Places {
  std::vector<std::uint32_t> of;  ///< by samples, 0 ... distinct - 1
  std::uint32_t distinct = 0;
};
[[nodiscard]] Places places(std::span<const double> values);

/// By parameters. `known`: numbers of the samples that y stands for, in order. NaN: fewer than 3 samples,
/// or where all values of one are the same.
[[nodiscard]] std::vector<double> rank_correlations(const std::vector<Places>& parameters,
                                                    const std::vector<std::uint32_t>& known,
                                                    std::span<const double> y);

}  // namespace condyle
