#pragma once

/// Quantiles of a sample: at level q the value at place q (n - 1) of the sorted sample, between two of
/// them linearly (type 7, the default of R and numpy).

#include <span>
#include <vector>

namespace condyle {

/// By `levels`, which ascend; NaN of an empty sample. Leaves the sample, which has no NaN, in another
/// order.
[[nodiscard]] std::vector<double> take_quantiles(std::span<double> sample,
                                                 std::span<const double> levels);

}  // namespace condyle
