#pragma once

/// Samples of a surface that may be far larger than what touches it, such as a ball of 20 m: no more of them than one can
/// afford. Surfaces of a knee have the spacing that is wanted.

#include <vector>

#include "condyle/surface/surface.h"

namespace condyle {

/// The spacing that is wanted [mm], or the wider one of about `kMostSamples` samples.
inline constexpr int kMostSamples = 20000;
[[nodiscard]] double affordable_spacing(const Surface& surface, double wanted);

[[nodiscard]] std::vector<Place> affordable_samples(const Surface& surface, double wanted);

}  // namespace condyle
