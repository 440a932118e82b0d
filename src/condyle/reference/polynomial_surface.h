#pragma once

/// A height polynomial as the engine sees a surface: the engine on the surfaces of the reference
/// model shows what part of a difference comes from surfaces alone.

#include <vector>

#include "condyle/reference/fit_heights.h"
#include "condyle/scene/fitted_surface.h"

namespace condyle {

/// Known within the outline of the points that it was fitted to.
[[nodiscard]] std::shared_ptr<const Surface> make_surface(const HeightSurface& surface);

/// The surfaces of a scene with fitted polynomials in place of patches and other kinds.
[[nodiscard]] std::vector<FittedSurface> with_polynomials(std::vector<FittedSurface> surfaces,
                                                          const std::vector<HeightFit>& heights);

}  // namespace condyle
