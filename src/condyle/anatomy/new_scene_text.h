#pragma once

/// A new knee as a scene file with comments that a person can follow.

#include <filesystem>
#include <string>

#include "condyle/anatomy/new_knee.h"

namespace condyle {

/// `scene` is where the text will stand: meshes are named relative to its folder.
[[nodiscard]] std::string new_scene_text(const NewKnee& knee, const std::filesystem::path& scene);

}  // namespace condyle
