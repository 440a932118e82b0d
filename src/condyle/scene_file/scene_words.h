#pragma once

/// Pieces of a scene file for those who write one.

#include <filesystem>
#include <string>

namespace condyle {

/// As TOML's basic string; control characters become spaces.
[[nodiscard]] std::string scene_string(const std::string& text);

/// As a comment: "# " and one line, control characters become spaces.
[[nodiscard]] std::string scene_comment(const std::string& text);

/// The path of a mesh as a scene that stands at `scene` names it: relative to its folder where that can
/// be.
[[nodiscard]] std::string mesh_path_in(const std::filesystem::path& scene,
                                       const std::filesystem::path& mesh);

/// The name that scenes have for a unit of length: "mm", "cm", "m"; empty for none of them.
[[nodiscard]] std::string unit_name(double to_mm);

}  // namespace condyle
