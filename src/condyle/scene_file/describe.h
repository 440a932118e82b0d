#pragma once

/// What a scene holds, in plain words for `condyle check`.

#include <string>

#include "condyle/scene/scene.h"

namespace condyle {

/// Several lines, lengths in mm, angles in deg, forces in N.
[[nodiscard]] std::string describe(const Scene& scene);

}  // namespace condyle
