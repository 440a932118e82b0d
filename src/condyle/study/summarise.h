#pragma once

/// From samples to what they say (study_summary.h): one output after the other, so that memory holds
/// no more than one.

#include <cstdint>
#include <vector>

#include "condyle/study/study_plan.h"
#include "condyle/study/study_summary.h"

namespace condyle {

/// All samples of one quantity: by samples and poses, NaN where a pose is not solved.
struct OutputSamples {
  const std::vector<double>& values;
  std::size_t poses = 0;
};

[[nodiscard]] StudyBand study_band(const OutputSamples& samples,
                                   const std::vector<double>& nominal);

/// `theta`: by parameters, then samples. `saltelli`: whether samples stand in the order of
/// SampleDesign's kSaltelli (then rank correlations are those of blocks A and B).
[[nodiscard]] StudyEffects study_effects(const OutputSamples& samples,
                                         const std::vector<std::vector<double>>& theta,
                                         bool saltelli);

/// status: PoseStatus by samples and poses.
[[nodiscard]] StudyFailures study_failures(const std::vector<std::uint8_t>& status,
                                           std::size_t poses,
                                           const std::vector<std::vector<double>>& theta);

}  // namespace condyle
