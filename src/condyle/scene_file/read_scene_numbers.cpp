#include "condyle/scene_file/read_scene_numbers.h"

#include <algorithm>
#include <string_view>

#include "condyle/scene/ligament_number.h"

namespace condyle {
namespace {

constexpr const char* kExpected = "names of numbers [\"aACL.reference_strain\", ...]";

/// A name that a scene may write, and what it stands for.
struct NamedNumber {
  SceneNumber number;
  std::string objection;  ///< why its owner has no such number; empty: it has
  [[nodiscard]] bool exists() const { return objection.empty(); }
};

class NumbersOf {
 public:
  explicit NumbersOf(const Scene& scene) : scene_(scene) {
    for (std::size_t i = 0; i < scene.ligaments.size(); ++i) add_ligament(static_cast<int>(i));
    for (std::size_t i = 0; i < scene.loads.size(); ++i) add_load(static_cast<int>(i));
    for (std::size_t i = 0; i < scene.conditions.size(); ++i)
      add(ParameterKind::kConditionValue, static_cast<int>(i), scene.conditions[i].name + ".value");
    for (std::size_t i = 0; i < scene.surfaces.size(); ++i) add_surface(static_cast<int>(i));
  }
  [[nodiscard]] const std::vector<NamedNumber>& all() const { return all_; }

 private:
  void add(ParameterKind kind,
           int index,
           const std::string& name,
           const std::string& objection = "",
           int body = -1) {
    all_.push_back({{kind, index, body, name}, objection});
  }

  void add_ligament(int i) {
    const LigamentDescription& ligament = scene_.ligaments[static_cast<std::size_t>(i)];
    for (const ParameterKind kind : kNumbersOfLaws)
      add(kind, i, ligament.name + "." + word_of(kind),
          has_number(ligament.law, kind) ? ""
                                         : "one of a ligament whose law is " + laws_with(kind));
    for (const Attachment& end : ligament.ends)
      add(ParameterKind::kInsertion, i,
          ligament.name + ".insertion." + scene_.bodies[static_cast<std::size_t>(end.body)].name,
          "", end.body);
  }

  void add_load(int i) {
    const LoadDescription& load = scene_.loads[static_cast<std::size_t>(i)];
    add(ParameterKind::kLoadScale, i, load.name + ".scale");
    add(ParameterKind::kLoadVector, i, load.name + ".vector");
    add(ParameterKind::kLoadPoint, i, load.name + ".point",
        load.moment ? "one of a force: a moment has no point" : "");
  }

  void add_surface(int i) {
    const SurfaceDescription& surface = scene_.surfaces[static_cast<std::size_t>(i)];
    bool meets = false, layered = false;
    for (const ContactDescription& contact : scene_.contacts) {
      const bool here = contact.surfaces[0] == i || contact.surfaces[1] == i;
      meets |= here;
      layered |= here && contact.layer.has_value() && surface.elastic.has_value();
    }
    add(ParameterKind::kSurfaceShift, i, surface.name + ".shift",
        meets ? "" : "one of a surface in a [[contact]]");
    add(ParameterKind::kLayerModulus, i, surface.name + ".modulus",
        layered ? "" : "one of a surface with a layer in a [[contact]] that has a law");
  }

  const Scene& scene_;
  std::vector<NamedNumber> all_;
};

/// Of every ligament that has it; `text` is "*.stiffness".
std::vector<SceneNumber> of_all_ligaments(const std::vector<NamedNumber>& all,
                                          const std::string& text,
                                          const Scene& scene) {
  std::vector<SceneNumber> found;
  for (const NamedNumber& named : all) {
    if (named.number.kind > ParameterKind::kInsertion || !named.exists()) continue;
    const LigamentDescription& owner =
        scene.ligaments[static_cast<std::size_t>(named.number.index)];
    const std::string_view word = std::string_view(named.number.name).substr(owner.name.size());
    if (word == std::string_view(text).substr(1)) found.push_back(named.number);
  }
  return found;
}

std::vector<std::string> wild_names(const Scene& scene) {
  std::vector<std::string> names;
  for (const ParameterKind kind : kNumbersOfLaws)
    names.push_back(std::string("*.") + word_of(kind));
  for (const BodyDescription& body : scene.bodies) names.push_back("*.insertion." + body.name);
  return names;
}

std::vector<SceneNumber> numbers_named(const Section& section,
                                       const std::string& key,
                                       const Value& name,
                                       const std::vector<NamedNumber>& all,
                                       const Scene& scene) {
  if (name.type == Value::Type::kText && name.text.starts_with("*")) {
    const std::vector<std::string> wild = wild_names(scene);
    (void)section.reference(key, name, "a number of ligaments", wild);
    std::vector<SceneNumber> found = of_all_ligaments(all, name.text, scene);
    if (found.empty()) section.fail(key, name, "a number that the law of some ligament has");
    return found;
  }
  std::vector<std::string> names;
  for (const NamedNumber& named : all) names.push_back(named.number.name);
  const int index = section.reference(key, name, "NAME.NUMBER", names);
  const NamedNumber& named = all[static_cast<std::size_t>(index)];
  if (!named.exists()) section.fail(key, name, named.objection);
  return {named.number};
}

}  // namespace

std::vector<SceneNumber> read_scene_numbers(const Section& section,
                                            const std::string& key,
                                            const Scene& scene) {
  const Value& list = section.value(key, kExpected);
  if (list.type != Value::Type::kArray || list.items.empty()) section.fail(key, list, kExpected);
  const NumbersOf numbers(scene);
  std::vector<SceneNumber> found;
  for (const Value& name : list.items) {
    for (SceneNumber& number : numbers_named(section, key, name, numbers.all(), scene)) {
      const bool twice = std::any_of(found.begin(), found.end(), [&](const SceneNumber& other) {
        return other.name == number.name;
      });
      if (twice) section.fail(key, name, "each number once (\"" + number.name + "\" is there)");
      found.push_back(std::move(number));
    }
  }
  return found;
}

}  // namespace condyle
