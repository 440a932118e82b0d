#pragma once

/// How far two curves over one abscissa are from each other, whatever their points.

#include <optional>
#include <vector>

namespace condyle {

/// Points as a run has them; NaN in x or y where there is none: nothing goes across it.
struct SampledCurve {
  std::vector<double> x, y;
};

/// Where and by how much, at all x of either curve at which both have a value: that of a point, or
/// straight between the two neighbours, of which neither is missing.
struct CurveDifference {
  double largest = 0;    ///< of b - a, with its sign
  double at = 0;         ///< x of the largest
  double rms = 0;        ///< over the places that are counted
  int count = 0;         ///< places; 0: the curves have none in common
  int interpolated = 0;  ///< of them those at which one of the two has no point
};

/// Nothing where a curve goes over some x more than once, to and fro.
[[nodiscard]] std::optional<CurveDifference> difference(const SampledCurve& a,
                                                        const SampledCurve& b);

/// Do both have points at the same x? Values count as the same within rounding.
[[nodiscard]] bool same_places(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace condyle
