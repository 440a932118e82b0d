#pragma once

/// How the patches of a scene came out, as a table on the standard output; nothing where there is
/// no patch.

#include <vector>

#include "condyle/scene/fitted_surface.h"

namespace condyle {

void print_fit(const std::vector<FittedSurface>& surfaces);
/// How far the patches lie from the mesh and how large the part is that can touch.
void print_known_parts(const std::vector<FittedSurface>& surfaces);

}  // namespace condyle
