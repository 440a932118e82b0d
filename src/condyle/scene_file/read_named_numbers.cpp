/// Which numbers a [[calibrate.parameter]] or a [[vary]] means.

#include <fmt/format.h>

#include <tuple>

#include "condyle/scene/ligament_number.h"
#include "condyle/scene_file/read_numbers.h"
#include "condyle/scene_file/read_sections.h"

namespace condyle {
namespace {

constexpr const char* kOf = "names [\"aACL\", ...], prefixes [\"ACL*\"], or \"*\" for all";

void read_what(const Section& section,
               const Scene& scene,
               const std::vector<std::string>& also,
               CalibrationParameter& parameter) {
  Choices<std::pair<ParameterKind, int>> kinds;
  for (const ParameterKind kind : kNumbersOfLaws) kinds.push_back({word_of(kind), {kind, -1}});
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    kinds.push_back(
        {"insertion." + scene.bodies[i].name, {ParameterKind::kInsertion, static_cast<int>(i)}});
  kinds.push_back({"load", {ParameterKind::kLoadScale, -1}});
  for (const std::string& word : also) kinds.push_back({word, {ParameterKind::kLoadScale, -1}});
  std::tie(parameter.what, parameter.body) = section.choice("what", kinds);
}

bool is_load(const CalibrationParameter& parameter) {
  return parameter.what == ParameterKind::kLoadScale;
}

/// Whether Scene::ligaments[index], or the load, has that number.
bool has_it(const Scene& scene, const CalibrationParameter& parameter, std::size_t index) {
  if (is_load(parameter)) return scene.loads[index].vector.norm() > 0;
  return has_number(scene.ligaments[index].law, parameter.what);
}

std::string what_has_it(const CalibrationParameter& parameter) {
  return is_load(parameter) ? "a load whose vector is not 0"
                            : "a ligament whose law is " + laws_with(parameter.what);
}

/// Those that one entry of `of` means.
std::vector<int> meant_by(const Value& entry,
                          const Section& section,
                          const Scene& scene,
                          const CalibrationParameter& parameter) {
  const std::vector<std::string> names =
      is_load(parameter) ? names_of(scene.loads) : names_of(scene.ligaments);
  const char* what = is_load(parameter) ? "the name of a load" : "the name of a ligament";
  const bool many = entry.type == Value::Type::kText && entry.text.ends_with('*');
  if (!many) {
    const int index = section.reference("of", entry, what, names);
    if (!has_it(scene, parameter, static_cast<std::size_t>(index)))
      section.fail("of", entry, what_has_it(parameter));
    return {index};
  }
  const std::string prefix = entry.text.substr(0, entry.text.size() - 1);
  std::vector<int> indices;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i].starts_with(prefix) && has_it(scene, parameter, i))
      indices.push_back(static_cast<int>(i));
  if (indices.empty())
    section.fail("of", entry, "the beginning of a name of " + what_has_it(parameter));
  return indices;
}

void take_once(const Value& entry,
               int index,
               const Section& section,
               const Scene& scene,
               CalibrationParameter& parameter,
               NamedNumbers& named) {
  const ParameterKind kind = parameter.what == ParameterKind::kSlackLength
                                 ? ParameterKind::kReferenceStrain
                                 : parameter.what;
  const auto [number, fresh] = named.try_emplace({kind, index, parameter.body}, entry.line);
  const auto at = static_cast<std::size_t>(index);
  if (!fresh)
    section.fail("of", entry,
                 fmt::format("numbers that are free once: that of \"{}\" is since line {}",
                             is_load(parameter) ? scene.loads[at].name : scene.ligaments[at].name,
                             number->second));
  parameter.of.push_back(index);
}

void read_of(const Section& section,
             const Scene& scene,
             CalibrationParameter& parameter,
             NamedNumbers& named) {
  const Value& of = section.value("of", kOf);
  const bool list = of.type == Value::Type::kArray && !of.items.empty();
  if (!list && of.type != Value::Type::kText) section.fail("of", kOf);
  const auto take = [&](const Value& entry) {
    for (const int index : meant_by(entry, section, scene, parameter))
      take_once(entry, index, section, scene, parameter, named);
  };
  if (!list) return take(of);
  for (const Value& entry : of.items) take(entry);
}

}  // namespace

CalibrationParameter read_named_numbers(const Section& section,
                                        const Scene& scene,
                                        NamedNumbers& named,
                                        const std::vector<std::string>& also) {
  CalibrationParameter parameter;
  read_what(section, scene, also, parameter);
  read_of(section, scene, parameter, named);
  if (section.has("together")) parameter.together = section.boolean("together");
  return parameter;
}

}  // namespace condyle
