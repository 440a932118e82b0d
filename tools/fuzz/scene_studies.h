#pragma once

/// What a made-up scene is for: [sweep], [laxity], [simulate], [calibrate].

#include <string>
#include <vector>

#include "fuzz/scene_lines.h"

namespace condyle::fuzz {

struct SceneNames {
  bool joint = false;
  std::vector<std::string> contacts, ligaments, loads, conditions;
};

void add_studies(SceneLines& out, const SceneNames& names);

}  // namespace condyle::fuzz
