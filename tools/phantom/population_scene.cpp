#include "phantom/population_scene.h"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "condyle/input_error.h"
#include "condyle/scene_file/document.h"
#include "condyle/scene_file/scene_words.h"
#include "condyle/scene_file/text_edit.h"

namespace condyle::phantom {

namespace {

double depth_of(Bone bone, const PhantomParameters& knee) {
  return bone == Bone::kFemur ? knee.femur.size.depth : knee.tibia.size.depth;
}

Bone bone_of(const Scene& scene, int body) {
  const std::string& name = scene.bodies[static_cast<std::size_t>(body)].name;
  for (const Bone bone : {Bone::kFemur, Bone::kTibia})
    if (name == bone_name(bone)) return bone;
  throw InputError(fmt::format("{}: body \"{}\", expected \"femur\" and \"tibia\" of the phantom",
                               scene.file.string(), name));
}

class Edits {
 public:
  explicit Edits(const Scene& scene)
      : scene_(scene), document_(parse_document(scene.text, scene.file.string())) {}

  /// The value of `key` in entry `index` of a list of tables.
  const Value& value(const char* list, std::size_t index, const char* key) const {
    const Value* tables = document_.find(list);
    const bool there = tables != nullptr && index < tables->items.size();
    return needed(there ? tables->items[index].find(key) : nullptr, key);
  }
  const Value& needed(const Value* value, const char* key) const {
    if (value == nullptr)
      throw InputError(fmt::format("{}: {} is missing, expected the shipped scene of the phantom",
                                   scene_.file.string(), key));
    return *value;
  }
  void set(const Value& value, std::string text) {
    edits_.push_back(edit_of(value, std::move(text)));
  }
  void set(const Value& point, const Eigen::Vector3d& p) {
    for (std::size_t c = 0; c < 3; ++c)
      set(point.items.at(c),
          fmt::format("{:.7f}", p[static_cast<Eigen::Index>(c)] / scene_.length_to_mm));
  }
  [[nodiscard]] const Value& document() const { return document_; }
  [[nodiscard]] std::string text() const { return edited(scene_.text, edits_); }

 private:
  const Scene& scene_;
  Value document_;
  std::vector<TextEdit> edits_;
};

}  // namespace

Eigen::Vector3d carried_point(Bone bone, const Eigen::Vector3d& p, const PhantomParameters& knee) {
  const Eigen::Vector3d from = project(bone, p);
  const double depth = (p - from).dot(normal(bone, from)) * depth_of(bone, knee);
  const Eigen::Vector3d to = project(bone, sized(bone, from, knee), knee);
  return to + depth * normal(bone, to, knee);
}

std::string carried_scene_text(const Scene& shipped,
                               const PhantomParameters& knee,
                               const std::string& name) {
  if (!shipped.wraps.empty())
    throw InputError(fmt::format("{}: has wraps, expected straight ligaments for a population",
                                 shipped.file.string()));
  Edits edits(shipped);
  edits.set(edits.needed(edits.document().find("title"), "title"),
            scene_string("Phantom, right knee " + name));
  for (std::size_t b = 0; b < shipped.bodies.size(); ++b) {
    const char* bone = bone_name(bone_of(shipped, static_cast<int>(b)));
    edits.set(edits.value("body", b, "mesh"), fmt::format("\"{}_{}.stl\"", name, bone));
  }
  for (std::size_t i = 0; i < shipped.ligaments.size(); ++i) {
    const Value& ends = edits.value("ligament", i, "ends");
    for (std::size_t e = 0; e < 2; ++e) {
      const Attachment& end = shipped.ligaments[i].ends[e];
      edits.set(edits.needed(ends.items.at(e).find("at"), "at"),
                carried_point(bone_of(shipped, end.body), end.at, knee));
    }
  }
  for (std::size_t i = 0; i < shipped.loads.size(); ++i) {
    const LoadDescription& load = shipped.loads[i];
    if (!load.moment)
      edits.set(edits.value("load", i, "at"), sized(bone_of(shipped, load.body), load.at, knee));
  }
  return edits.text();
}

}  // namespace condyle::phantom
