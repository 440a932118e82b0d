#pragma once

/// What a study says, told from its samples in their order: plain data. Of each knee of a population by
/// itself where there are samples of it, and of all together.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace condyle {

/// Deviation over the largest value, of samples that do not vary: what a solver's tolerance leaves.
inline constexpr double kLeastDeviation = 1e-9;

inline constexpr std::array<double, 5> kBandLevels = {0.05, 0.25, 0.5, 0.75, 0.95};

/// One quantity over the sweep, over all samples whose pose converged.
struct StudyBand {
  std::vector<double> mean, sd, nominal;         ///< by poses; NaN: none
  std::array<std::vector<double>, 5> quantiles;  ///< by kBandLevels and poses
  std::vector<long> samples;                     ///< by poses: how many
};

/// One of Sobol's indices at one pose, with its 95 % interval.
struct IndexEstimate {
  double value = 0, lower = 0, upper = 0;  ///< NaN: no variance, or too few samples
};

/// NaN where the interval of 95 % is wider than 1, all that an index can be: the samples are too few.
[[nodiscard]] inline double known_value(const IndexEstimate& index) {
  return index.upper - index.lower < 1 ? index.value : std::numeric_limits<double>::quiet_NaN();
}

/// What a rank correlation of so many independent samples exceeds by chance in one case of 370: without any dependence
/// its standard deviation is 1/√(n - 1).
[[nodiscard]] inline double chance_rank(double samples) {
  constexpr double kDeviations = 3;
  return kDeviations / std::sqrt(std::max(samples - 1, 1e-9));
}
/// NaN where it may be chance.
[[nodiscard]] inline double known_rank(double correlation, double samples) {
  return std::abs(correlation) > chance_rank(samples) ? correlation
                                                      : std::numeric_limits<double>::quiet_NaN();
}

/// By parameters and poses. Indices of designs of Saltelli only; empty else.
struct StudyEffects {
  std::vector<std::vector<IndexEstimate>> first, total;
  std::vector<std::vector<double>> rank;  ///< Spearman's correlation of parameter and quantity
};

struct StudyFailures {
  long poses = 0, failed = 0;                   ///< of all samples
  std::vector<long> by_pose;                    ///< failed
  std::vector<std::array<long, 16>> by_status;  ///< by poses: how many of each PoseStatus
  /// By parameters: share of failed poses in each quarter of the parameter's samples. Where these
  /// differ bands are biased.
  std::vector<std::array<double, 4>> by_quartile;
  long incomplete = 0;  ///< samples with any failed pose
};

struct StudySummary {
  std::vector<StudyBand> bands;       ///< by outputs
  std::vector<StudyEffects> effects;  ///< by outputs
  StudyFailures failures;
};

}  // namespace condyle
