#pragma once

/// Study files (TOML, docs/study.md).

#include <filesystem>
#include <string>

#include "condyle/scene/study_with_scenes.h"

namespace condyle {

/// Reads and checks study and scenes. Where the study has no [[vary]] and its design is a table, what
/// varies is what the first scene's [calibrate] leaves free. Throws InputError: file, line, key, value
/// and what was expected; for scenes whose sweeps do not visit the same values, or which do not have
/// the numbers that vary.
[[nodiscard]] ReadStudy read_study(const std::filesystem::path& file);

/// The same of a text; paths are told from the folder of `file`, which need not be there.
[[nodiscard]] ReadStudy parse_study(std::string text, const std::filesystem::path& file);

}  // namespace condyle
