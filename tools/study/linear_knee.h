#pragma once

/// A knee in a study whose Sobol's indices are known: where its numbers vary by so little that every
/// output is linear in them, the share of number j in the variance is (∂y/∂θ_j sd_j)² over the sum of
/// all, first order and total alike; the derivatives are those of equilibrium/sensitivity.h.

#include <filesystem>
#include <vector>

#include "condyle/study/study_plan.h"
#include "condyle/study/study_summary.h"

namespace condyle::study {

struct LinearKnee {
  StudyPlan plan;                           ///< saltelli, reference strains of all ligaments
  std::vector<std::vector<double>> closed;  ///< of output 0: by parameters and poses
};

/// Of the anterior drawer, with a deviation of 1e-6 of each strain. `points`: of each block.
[[nodiscard]] LinearKnee linear_knee(const std::filesystem::path& scene, long points);

/// How far the knee is from linear, and the solver's tolerance: closed indices are known to that.
inline constexpr double kClosedWithin = 1e-5;

/// Whether the interval of an index holds its closed value.
[[nodiscard]] inline bool holds(const IndexEstimate& e, double closed) {
  return e.lower - kClosedWithin <= closed && closed <= e.upper + kClosedWithin;
}

/// All samples of output 0, and what they say.
[[nodiscard]] StudyEffects effects_of(const LinearKnee& knee);

}  // namespace condyle::study
