#pragma once

/// Free parameters as people are told of them: strains in %, factors in place of logarithms, turns in
/// deg.

#include <string>
#include <vector>

#include "condyle/calibration/calibration.h"

namespace condyle {

struct ToldParameter {
  std::string name, unit;  ///< "%", "factor" (deviations are those of its logarithm), "mm", "deg"
  double scene = 0;        ///< before
  double mean = 0;         ///< fitted
  double prior_sd = 0, sd = 0, sample_sd = 0;  ///< NaN: none; at a bound there is none
  double shrinkage = 0;                        ///< posterior over prior sd [-]
  bool at_bound = false;
  bool parts = false;  ///< sd and sample_sd by more than 10 % and than so many samples leave open

  /// The one to take: that of the samples where the two part.
  [[nodiscard]] double best_sd() const { return parts ? sample_sd : sd; }
};

[[nodiscard]] std::vector<ToldParameter> told_parameters(const CalibrationResult& result);

}  // namespace condyle
