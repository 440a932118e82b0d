#include "condyle/surface/affordable_samples.h"

#include <algorithm>
#include <cmath>

namespace condyle {

/// The area is told by a coarse cover.
double affordable_spacing(const Surface& surface, double wanted) {
  constexpr std::size_t kEnough = 64;
  const double size = surface.extent().radius;
  if (!std::isfinite(size)) return wanted;
  for (double coarse = size / 2; coarse > wanted; coarse /= 2) {
    const std::size_t n = surface.samples(coarse).size();
    if (n < kEnough) continue;
    return std::max(wanted, coarse * std::sqrt(static_cast<double>(n) / kMostSamples));
  }
  return wanted;
}

std::vector<Place> affordable_samples(const Surface& surface, double wanted) {
  return surface.samples(affordable_spacing(surface, wanted));
}

}  // namespace condyle
