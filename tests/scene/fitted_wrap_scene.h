#pragma once

/// The small scene whose ligament goes over an ellipsoid that is fitted to the tibia's mesh.

#include <string>

#include "condyle/scene_file/read_scene.h"
#include "scene/small_scene.h"

namespace condyle::test {

/// With further keys of the wrap, a line each.
inline std::string fitted_wrap_text(const std::string& keys = "") {
  std::string text =
      with(kSmallScene, "name = \"tibia\"\nstart", "name = \"tibia\"\nmesh = \"tibia.ply\"\nstart");
  text = with(text, "[[ligament]]",
              "[[wrap]]\nname = \"rim\"\nbody = \"tibia\"\nkind = \"ellipsoid\"\nfit = \"bone\"\n" +
                  keys + "\n[[ligament]]");
  text = with(text, "slack_length = 30", "reference_strain = 0.1");
  return with(text, "law =", "wraps = [\"rim\"]\nlaw =");
}

inline Scene fitted_wrap_scene(const std::string& keys = "") {
  return parse_scene(fitted_wrap_text(keys), "knee.toml");
}

}  // namespace condyle::test
