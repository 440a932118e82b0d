#pragma once

/// Whether the layers of a scene's contacts have room on its surfaces.

#include <vector>

#include "condyle/scene/fitted_surface.h"
#include "condyle/scene/scene.h"

namespace condyle {

/// Is the surface of that index one of a contact of layers?
[[nodiscard]] bool carries_layer(const Scene& scene, int surface);

/// Throws InputError for a layer that reaches the least radius of a convex polynomial surface, or folds
/// over on more than a quarter of the known part of a patch. Fitted to a rough mesh a patch has
/// small bends that are none of the bone's, at its edges above all: where more than a twentieth
/// folds over, the report of the fit gets a warning, in place of one of an earlier check, and less is let pass.
void check_layers(const Scene& scene, std::vector<FittedSurface>& surfaces);

}  // namespace condyle
