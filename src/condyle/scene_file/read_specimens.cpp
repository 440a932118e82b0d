/// Which knees a study is of.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <string>

#include "condyle/file_ending.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/scene_file/read_sections.h"
#include "condyle/scene_file/read_study_parts.h"

namespace condyle {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSpecimens = "the path of a scene, a list of them, or a folder of scenes";

bool has_bodies(const fs::path& file) {
  return parse_document(text_of(file, "a scene (TOML)"), file.string()).find("body") != nullptr;
}

/// The scenes of a folder by name; other files beside them are passed over.
std::vector<fs::path> scenes_of(const fs::path& folder, const Section& root, const Value& entry) {
  std::vector<fs::path> scenes;
  for (const fs::directory_entry& file : fs::directory_iterator(folder))
    if (file_ending(file.path()) == ".toml" && file.is_regular_file() && has_bodies(file.path()))
      scenes.push_back(file.path());
  if (scenes.empty())
    root.fail(
        "specimens", entry,
        fmt::format("a folder of scenes (there is no *.toml with bodies in {})", folder.string()));
  std::sort(scenes.begin(), scenes.end());
  return scenes;
}

/// What one entry means.
std::vector<fs::path> scenes_at(const Section& root, const Value& entry) {
  if (entry.type != Value::Type::kText || entry.text.empty())
    root.fail("specimens", entry, kSpecimens);
  const fs::path path = root.source().folder / entry.text;
  std::error_code error;
  if (fs::is_directory(path, error)) return scenes_of(path, root, entry);
  if (!fs::exists(path, error))
    root.fail("specimens", entry,
              fmt::format("the path of a scene or of a folder of scenes (there is no {})",
                          path.string()));
  return {path};
}

/// Scenes by the names of their files: results tell knees apart by these.
using ScenesByName = std::map<std::string, fs::path>;

void expect_new(const fs::path& scene,
                const Section& root,
                const Value& entry,
                ScenesByName& before) {
  const auto [other, fresh] = before.try_emplace(scene.stem().string(), scene);
  if (fresh) return;
  std::error_code error;
  if (fs::equivalent(scene, other->second, error))
    root.fail("specimens", entry, "each scene once: " + scene.string());
  root.fail("specimens", entry,
            fmt::format("scenes whose files have different names: {} and {}",
                        other->second.string(), scene.string()));
}

/// Two sweeps of one name: do they vary the same kind of condition, or both a force or a moment?
bool same_kind(const Scene& scene, const Scene& first) {
  const auto i = static_cast<std::size_t>(scene.sweep->index),
             k = static_cast<std::size_t>(first.sweep->index);
  return scene.sweep->varies_load ? scene.loads[i].moment == first.loads[k].moment
                                  : scene.conditions[i].kind == first.conditions[k].kind;
}

/// What keeps the scene's sweep from standing beside that of the first one; empty: nothing.
std::string sweep_mistake(const Scene& scene, const Scene& first) {
  if (!scene.sweep) return "has no [sweep]";
  if (scene.sweep->arc_length) return "has a [sweep] with path = \"arc length\"";
  if (!first.sweep || &scene == &first) return {};
  const SweepDescription &a = *scene.sweep, &b = *first.sweep;
  const auto same = [](double x, double y) { return std::abs(x - y) <= 1e-9 * (1 + std::abs(y)); };
  const bool alike =
      a.vary == b.vary && a.varies_load == b.varies_load && same_kind(scene, first) &&
      std::equal(a.values.begin(), a.values.end(), b.values.begin(), b.values.end(), same);
  return alike ? "" : "has a [sweep] that visits other poses than that of " + first.file.string();
}

}  // namespace

void read_specimens(const Section& root, ReadStudy& read) {
  const Value& list = root.value("specimens", kSpecimens);
  const bool many = list.type == Value::Type::kArray && !list.items.empty();
  std::vector<std::reference_wrapper<const Value>> entries;
  if (many) entries.assign(list.items.begin(), list.items.end());
  if (!many) entries.emplace_back(list);
  ScenesByName before;
  for (const Value& entry : entries) {
    for (const fs::path& scene : scenes_at(root, entry)) {
      expect_new(scene, root, entry, before);
      read.study.specimens.push_back(scene);
      read.scenes.push_back(read_scene(scene));
      const std::string mistake = sweep_mistake(read.scenes.back(), read.scenes.front());
      if (!mistake.empty())
        root.fail("specimens", entry,
                  fmt::format("scenes with a [sweep] in steps over the same values: {} {}",
                              scene.string(), mistake));
    }
  }
}

}  // namespace condyle
