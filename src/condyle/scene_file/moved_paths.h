#pragma once

/// The text of a scene that is to stand in another folder: its paths are told from there.

#include <filesystem>
#include <string>
#include <vector>

#include "condyle/scene_file/text_edit.h"

namespace condyle {

/// Edits of the relative paths in `document`, of meshes and of measurements, that are told from the folder of the file
/// `from`: from the folder of `to` they lead to the same files. None where both stand in one folder.
[[nodiscard]] std::vector<TextEdit> moved_paths(const Value& document,
                                                const std::filesystem::path& from,
                                                const std::filesystem::path& to);

/// The text of a scene file `from` with these edits. Throws InputError where it is not TOML.
[[nodiscard]] std::string moved_scene_text(const std::string& text,
                                           const std::filesystem::path& from,
                                           const std::filesystem::path& to);

}  // namespace condyle
