#pragma once

/// The keys of a scene that a fit hangs on, with what they hold and what to try in their place: for the message of a fit
/// that fails. Values in the units of the scene.

#include <string>

#include "condyle/scene/scene.h"

namespace condyle {

/// Of the spline: fit.smoothing, fit.control_points.
[[nodiscard]] std::string fit_keys(const PatchDescription& patch, const Scene& scene);

/// Of the region that it covers: region.angles, region.least_cosine, region.box.
[[nodiscard]] std::string region_keys(const PatchDescription& patch, const Scene& scene);

}  // namespace condyle
