#pragma once

/// The scenes that tests of invariance go through: those that are shipped, and those of real knees
/// where they are at hand. Studies (data/studies) are none.

#include <algorithm>
#include <filesystem>
#include <vector>

namespace condyle::test {

namespace detail {
inline void add_scenes(const std::filesystem::path& folder,
                       std::vector<std::filesystem::path>& scenes) {
  namespace fs = std::filesystem;
  if (!fs::exists(folder)) return;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".toml" && entry.path().parent_path().filename() != "studies")
      scenes.push_back(entry.path());
  std::sort(scenes.begin(), scenes.end());
}
}  // namespace detail

inline std::vector<std::filesystem::path> shipped_scenes() {
  std::vector<std::filesystem::path> scenes;
  detail::add_scenes(std::filesystem::path(CONDYLE_SOURCE_DIR) / "data", scenes);
  return scenes;
}

/// Empty where the specimens are absent.
inline std::vector<std::filesystem::path> specimen_scenes() {
  namespace fs = std::filesystem;
  const fs::path root(CONDYLE_SOURCE_DIR), specimens = root / "../shared/specimens";
  std::vector<fs::path> scenes;
  if (!fs::exists(specimens)) return scenes;
  detail::add_scenes(specimens, scenes);
  detail::add_scenes(root / "tests/data", scenes);
  return scenes;
}

}  // namespace condyle::test
