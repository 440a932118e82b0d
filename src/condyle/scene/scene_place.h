#pragma once

/// Where a table of a scene stands, which errors about it begin with.

#include <string>

#include "condyle/scene/scene.h"

namespace condyle {

/// "knee.toml:41: [[ligament]] "aACL""; without a line for what was made by code.
[[nodiscard]] std::string place_of(const Scene& scene, const SurfaceDescription& surface);
[[nodiscard]] std::string place_of(const Scene& scene, const WrapDescription& wrap);
[[nodiscard]] std::string place_of(const Scene& scene, const LigamentDescription& ligament);

}  // namespace condyle
