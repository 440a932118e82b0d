#pragma once

/// The smoothing length chosen from the data.
///
/// What a mesh leaves beside a smooth surface is texture that neighbouring vertices share, so plain
/// cross-validation always votes for following it. Here fits of growing smoothing length are taken
/// from each other; what lies between them, band by band, is explained as texture of some strength
/// and correlation length, S(k), and shape whose spectrum falls as a power of k. The two tell what
/// error to expect of a fit that passes H(k) = 1/(1 + (ℓk)⁶),
///     E(ℓ) = (1/2π) ∫ w H² S_texture k dk + (1/2π) ∫ w (1 - H)² S_shape k dk,
/// w = k² for the normal, which is what moves a pose, 1 for the position. docs/surface.md derives it
/// and shows what was measured.

#include <vector>

#include "condyle/surface/fit_system.h"

namespace condyle {

/// rms amplitude and length l of the correlation exp(-d²/2l²) [mm].
struct Texture {
  double rms = 0, correlation = 1.5;
};

enum class SmoothingAim {
  kNormals,    ///< least error of the normals; where it is flat, the longest of the lengths that
               ///< come near
  kPositions,  ///< least error of position
};

struct SmoothingOptions {
  SmoothingAim aim = SmoothingAim::kNormals;
  double least = 1, greatest = 6;        ///< lengths allowed [mm]
  Texture least_texture = {0.135, 1.5};  ///< that every segmentation has, smoothed as it may be
};

struct SmoothingChoice {
  double length = 0;  ///< [mm]
  Texture texture;    ///< inferred, the likeliest
  double error = 0;   ///< expected, rms: of the normal [rad] or distance from the surface [mm]
};

/// What counts for the choice at one data point; all points count for the fits.
struct Judgement {
  bool counts = true;
  double weight = 1;     ///< beside its area
  double smoothing = 1;  ///< the smoothing length there as a fraction of ℓ
};

[[nodiscard]] SmoothingChoice choose_smoothing(const SplineGrid& grid,
                                               const std::vector<DataPoint>& points,
                                               const std::vector<Judgement>& judged,
                                               const PenaltyTerm& penalty,
                                               const SmoothingOptions& options = {});

}  // namespace condyle
