#pragma once

/// The smoothing length chosen from the data.
///
/// What a mesh leaves beside a smooth surface is texture that neighbouring vertices share, so plain
/// cross-validation always votes for following it. Here the expected error of the patch is
/// estimated with that sharing in the account [Mallows 1973]:
///     E(ℓ) = mean squared distance(ℓ) + 2/(2π) ∫ S(k) k dk / (1 + (ℓk)⁶),
/// where S is the spectrum of the texture: its variance from what is left at ℓ = 1 mm but no less
/// than any segmentation has, its correlation length that of segmentations. docs/surface.md derives
/// it and shows what was measured.

#include <vector>

#include "surface/fit_system.h"

namespace condyle {

struct SmoothingOptions {
  double least = 0.75, greatest = 6;  ///< lengths allowed [mm]
  double texture_correlation =
      1.5;  ///< length l of the correlation exp(-d²/2l²) that is expected [mm]
  double least_texture =
      0.08;  ///< rms amplitude that every segmentation has, smoothed as it may be [mm]
};

struct SmoothingChoice {
  double length = 0;   ///< [mm]
  double texture = 0;  ///< rms amplitude inferred [mm]
};

/// `judged[i]` tells whether point i counts for the choice (all points count for the fits).
[[nodiscard]] SmoothingChoice choose_smoothing(const SplineGrid& grid,
                                               const std::vector<DataPoint>& points,
                                               const std::vector<bool>& judged,
                                               const PenaltyTerm& penalty,
                                               const SmoothingOptions& options = {});

}  // namespace condyle
