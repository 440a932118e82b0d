#pragma once

/// Study files (TOML, docs/study.md).

#include <filesystem>
#include <string>
#include <vector>

#include "condyle/scene/scene.h"
#include "condyle/scene/study_description.h"

namespace condyle {

/// A study with its knees as read.
struct ReadStudy {
  StudyDescription study;
  std::vector<Scene> scenes;                      ///< as StudyDescription::specimens
  std::vector<std::vector<VariedNumber>> varied;  ///< by scene: the same numbers of each
};

/// Reads and checks study and scenes. Where the study has no [[vary]] and its design is a table, what
/// varies is what the first scene's [calibrate] leaves free. Throws InputError: file, line, key, value
/// and what was expected; for scenes whose sweeps do not visit the same values, or which do not have
/// the numbers that vary.
[[nodiscard]] ReadStudy read_study(const std::filesystem::path& file);

}  // namespace condyle
