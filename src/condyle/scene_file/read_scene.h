#pragma once

/// Scene files (TOML, docs/scene.md) into a Scene in the units used inside. toml++ lives here and
/// nowhere else.

#include <filesystem>
#include <string>

#include "condyle/scene/scene.h"

namespace condyle {

/// Reads and checks. Throws InputError: file, line, key, value and what was expected; unknown keys
/// are errors.
[[nodiscard]] Scene read_scene(const std::filesystem::path& file);

/// The same from text; relative paths are taken from the folder of `file`, which is named in
/// messages. The meshes that it names need not be there, unless they are asked to.
[[nodiscard]] Scene parse_scene(const std::string& text,
                                const std::filesystem::path& file,
                                bool meshes_must_exist = false);

}  // namespace condyle
