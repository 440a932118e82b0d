#pragma once

/// Round values for the ticks of an axis.

#include <vector>

namespace condyle {

/// Multiples of 1, 2 or 5 times a power of ten from `low` to `high`, ends within, about `most` of them at most. None where
/// high - low is below 1e-12 of the greater one: such steps are hardly more than rounding of the values.
[[nodiscard]] std::vector<double> round_ticks(double low, double high, int most);

}  // namespace condyle
