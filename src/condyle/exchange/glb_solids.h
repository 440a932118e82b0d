#pragma once

/// Small round things of an animated scene.

#include <string>

#include "condyle/exchange/glb_file.h"

namespace condyle {

/// From y = 0 to y = 1 [m], with ends.
[[nodiscard]] GlbMesh unit_cylinder(const std::string& name, int material, double radius);

/// An octahedron about the origin, its corners on the axes at this distance.
[[nodiscard]] GlbMesh diamond(const std::string& name, int material, double radius);

/// About the origin.
[[nodiscard]] GlbMesh ball(const std::string& name, int material, double radius);

}  // namespace condyle
