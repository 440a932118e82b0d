#pragma once

/// The phantom knee as OpenSim-JAM would write it, changed, and the scene that its import makes.

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "condyle/exchange/osim_scene.h"
#include "support/scratch_folder.h"

namespace condyle::test {

inline const std::filesystem::path kPhantomModel =
    CONDYLE_SOURCE_DIR "/tests/data/phantom_jam.osim";
inline const std::filesystem::path kUnwrittenScene = CONDYLE_SOURCE_DIR "/tests/data/imported.toml";

inline OsimScene imported(const std::filesystem::path& file,
                          const std::filesystem::path& scene,
                          const OsimOptions& options = {}) {
  const OsimModel model = read_osim(file);
  return osim_scene(model, find_knee(model, file.string(), options), file, scene);
}

inline bool has_note(const OsimScene& scene, const std::string& note) {
  for (const std::string& line : scene.notes)
    if (line == note) return true;
  return false;
}

/// `text` with every occurrence of `from` replaced.
inline std::string with_all(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

/// The model, changed, and the scene of it.
inline OsimScene imported_text(const std::string& text, const std::string& name) {
  const std::filesystem::path folder = fresh_folder(name);
  std::ofstream(folder / "model.osim")
      << with_all(text, "../../meshes", CONDYLE_SOURCE_DIR "/meshes");
  OsimScene scene = imported(folder / "model.osim", folder / "knee.toml");
  std::filesystem::remove_all(folder);
  return scene;
}

inline std::string text_of_model() {
  std::ifstream stream(kPhantomModel);
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace condyle::test
