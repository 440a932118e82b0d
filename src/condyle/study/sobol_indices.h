#pragma once

/// Sobol's first-order and total indices of one number from a design of Saltelli, each with an interval.
///
/// First order: the estimator of Monod, asymptotically efficient [Janon 2014], less what blocks A and B
/// have in common by chance; total: [Jansen 1999] over the variance of the two blocks that it compares,
/// so that it stays between 0 and 2 where few samples have all of the variance. Both are ratios of means:
/// the intervals of 95 % follow from the spread of the ratio's error over base points (delta method). They hold for independent base points; Sobol points are spread more
/// evenly, and the intervals are then wider than need be. A base point of which any of the d + 2 values
/// is missing is left out.

#include <cstddef>
#include <vector>

#include "condyle/study/study_summary.h"

namespace condyle {

struct SobolIndices {
  std::vector<IndexEstimate> first, total;  ///< by parameters; NaN: fewer than 4 base points, or a
                                            ///< deviation below 1e-9 of the largest value
  long points = 0;                          ///< base points used
  double mean = 0, variance = 0;            ///< over blocks A and B
};

/// y: by base points and blocks A, B, AB_1 ... AB_d; `stride` apart.
[[nodiscard]] SobolIndices sobol_indices(const double* y,
                                         std::size_t points,
                                         std::size_t parameters,
                                         std::size_t stride);

}  // namespace condyle
