#pragma once

/// What a study says, in words for the standard output.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "condyle/results/study_file.h"

namespace condyle {

/// Knees, samples and poses; how many failed and why, and where that depends on what varies; of each
/// output where its band is widest, and what it depends on most there.
[[nodiscard]] std::vector<std::string> study_lines(const StudyView& view);

/// The pose at which the band of 5 to 95 % is widest; none where there is no number.
[[nodiscard]] std::optional<std::size_t> widest_pose(const StudyBand& band);

/// The least and the greatest share; a quarter without samples (NaN) is left out.
struct QuarterRange {
  double low = 0, high = 0;
};
[[nodiscard]] QuarterRange range_of_quarters(const std::array<double, 4>& shares);

/// Whether failed poses are more frequent in some quarter of the parameter's samples than chance
/// (four deviations, poses of a sample and knees of a point failing together) explains.
[[nodiscard]] bool failures_depend_on(const StudyView& view, std::size_t parameter);

/// The parameters by the size of their effect on an output at a pose, the largest first: total index
/// where there are indices, else rank correlation; those that are not known are left out.
struct EffectSize {
  std::size_t parameter = 0;
  double value = 0;
};
[[nodiscard]] std::vector<EffectSize> largest_effects(const StudyView& view,
                                                      std::size_t output,
                                                      std::size_t pose);

/// Samples whose numbers are independent: knees share the numbers of a point, and of a design of Saltelli blocks A and
/// B are by themselves.
[[nodiscard]] double independent_samples(const StudyView& view);
/// Of these, those of an output at a pose that have a result.
[[nodiscard]] double independent_samples(const StudyView& view,
                                         const StudyBand& band,
                                         std::size_t pose);

/// Whether some rank correlation that would be named may be chance (known_rank), and what is said of them.
[[nodiscard]] bool has_chance_ranks(const StudyView& view);
inline constexpr const char* kChanceRanks =
    "Rank correlations below 3/√(n - 1) of n independent samples may be chance and are left out.";

/// Whether some index is not known (known_value), and what is said of such indices.
[[nodiscard]] bool has_unknown_indices(const StudyView& view);
inline constexpr const char* kTooFewSamples =
    "Indices whose interval of 95 % is wider than 1 are left out: too few samples.";

}  // namespace condyle
