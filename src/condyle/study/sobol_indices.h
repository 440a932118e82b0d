#pragma once

/// Sobol's first-order and total indices of one number from a design of Saltelli, each with an interval.
///
/// First order: Janon, Monod et al. [2014], asymptotically efficient; total: Jansen [1999]; intervals
/// of 95 % by the delta method over base points. A base point of which any of the d + 2 values is
/// missing is left out.

#include <cstddef>
#include <vector>

#include "condyle/study/study_summary.h"

namespace condyle {

struct SobolIndices {
  std::vector<IndexEstimate> first, total;  ///< by parameters
  long points = 0;                          ///< base points used
  double mean = 0, variance = 0;
};

/// y: by base points and blocks A, B, AB_1 ... AB_d; `stride` apart.
[[nodiscard]] SobolIndices sobol_indices(const double* y,
                                         std::size_t points,
                                         std::size_t parameters,
                                         std::size_t stride);

}  // namespace condyle
