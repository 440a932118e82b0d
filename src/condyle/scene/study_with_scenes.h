#pragma once

/// A study with the knees that it names.

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

}  // namespace condyle
