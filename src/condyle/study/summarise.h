#pragma once

/// From samples to what they say (study_summary.h): one output after the other, so that memory holds
/// no more than one. Nothing depends on the number of threads; 0: as many as there are cores.

#include <cstdint>
#include <vector>

#include "condyle/study/rank_correlation.h"
#include "condyle/study/study_summary.h"

namespace condyle {

/// All samples of one quantity: by samples and poses, NaN where a pose is not solved.
struct OutputSamples {
  const std::vector<double>& values;
  std::size_t poses = 0;
};

[[nodiscard]] StudyBand study_band(const OutputSamples& samples,
                                   const std::vector<double>& nominal,
                                   int threads = 1);

/// A correlation of so many samples is known within 0.004: more of them are passed over, since sorting
/// all would take longer than sweeping cheap knees.
inline constexpr std::size_t kMostRanked = 65536;

/// The parameters of samples as study_effects needs them: made once for all outputs.
struct RankedParameters {
  bool saltelli = false;
  std::vector<std::uint32_t>
      samples;  ///< that are ranked, in order, drawn from all; kSaltelli: from A and B
  std::vector<Places> places;  ///< by parameters, of these samples
};

/// Samples, in order, whose values of a number are not those of others: all, or blocks A and B of a design of Saltelli.
[[nodiscard]] std::vector<std::uint32_t> own_samples(std::size_t samples,
                                                     std::size_t parameters,
                                                     bool saltelli);

/// `theta`: by parameters, then samples. `saltelli`: whether samples stand in the order of
/// SampleDesign's kSaltelli (then rank correlations are those of blocks A and B).
[[nodiscard]] RankedParameters ranked_parameters(const std::vector<std::vector<double>>& theta,
                                                 bool saltelli);

/// Of several knees together first-order indices of a design of Saltelli are those of parameter and
/// knee, since a base point's blocks share the knee.
[[nodiscard]] StudyEffects study_effects(const OutputSamples& samples,
                                         const RankedParameters& parameters,
                                         int threads = 1);
[[nodiscard]] StudyEffects study_effects(const OutputSamples& samples,
                                         const std::vector<std::vector<double>>& theta,
                                         bool saltelli);

/// status: PoseStatus by samples and poses. `saltelli`: the quarters of a parameter are those of blocks A and B, as
/// others repeat its values.
[[nodiscard]] StudyFailures study_failures(const std::vector<std::uint8_t>& status,
                                           std::size_t poses,
                                           const std::vector<std::vector<double>>& theta,
                                           bool saltelli);

}  // namespace condyle
