#pragma once

#include <algorithm>
#include <vector>

namespace condyle {

/// The span i of ascending breaks with breaks[i] <= t < breaks[i+1]; the last one holds its end, too. Breaks in equal
/// steps are looked up by the inverse of the step (0: they are not). What lies outside is in the span beside it;
/// what is no number is in the first, and the numbers of its point are none either.
[[nodiscard]] inline int knot_span(const std::vector<double>& breaks,
                                   double inverse_step,
                                   double t) {
  const int last = static_cast<int>(breaks.size()) - 2;
  if (inverse_step > 0) [[likely]] {
    const double way = std::max(0.0, (t - breaks.front()) * inverse_step);
    return static_cast<int>(std::min(way, static_cast<double>(last)));
  }
  const auto above = std::upper_bound(breaks.begin() + 1, breaks.end() - 1, t);
  return static_cast<int>(above - breaks.begin()) - 1;
}

}  // namespace condyle
