#pragma once

/// A new knee as a scene file with comments that a person can follow.

#include <filesystem>
#include <string>

#include "condyle/anatomy/new_knee.h"

namespace condyle {

/// `scene` is where the text will stand: meshes are named relative to its folder.
[[nodiscard]] std::string new_scene_text(const NewKnee& knee, const std::filesystem::path& scene);

/// The scene of a knee that is being made, which has no file yet. Throws InputError as the reader of scene files does.
[[nodiscard]] Scene scene_of(const NewKnee& knee);
/// What an InputError of that scene says, without the name of a file that nobody has.
[[nodiscard]] std::string without_file(std::string error);

}  // namespace condyle
