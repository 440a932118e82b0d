#include "condyle/study/study_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "condyle/elements/joint_table.h"
#include "condyle/input_error.h"

namespace condyle {
namespace {

const Unit kMillimetre{"mm", 1}, kNewton{"N", 1}, kRatio{"1", 1};
const Unit kDegree{"deg", std::numbers::pi / 180};

/// What is asked for of a ligament by a word.
struct LigamentWord {
  const char* word;
  OutputKind kind;
  const Unit& unit;
};
const LigamentWord kOfLigament[] = {{"force", OutputKind::kLigamentForce, kNewton},
                                    {"strain", OutputKind::kLigamentStrain, kRatio},
                                    {"length", OutputKind::kLigamentLength, kMillimetre}};

/// The outputs that a scene has, and those of them that words ask for.
class OutputList {
 public:
  OutputList(const Scene& scene, const std::string& study) : scene_(scene), study_(study) {}

  void add(const std::string& word) {
    const auto dot = word.rfind('.');
    const std::string owner = word.substr(0, dot);
    const std::string what = dot == std::string::npos ? "" : word.substr(dot + 1);
    const bool found = owner == "joint"      ? add_joint(what)
                       : owner == "contact"  ? add_of_contacts(what)
                       : owner == "ligament" ? add_of_ligaments(what)
                                             : add_of_one(owner, what);
    if (!found) refuse(word);
  }

  std::vector<StudyOutput> outputs;

 private:
  void keep(const std::string& name, const Unit& unit, const PoseOutput& output) {
    const auto known = std::find_if(outputs.begin(), outputs.end(),
                                    [&](const StudyOutput& other) { return other.name == name; });
    if (known == outputs.end()) {
      outputs.push_back({name, unit, output});
    } else if (known->output.kind != output.kind) {
      throw InputError(fmt::format(
          "{}: outputs: \"{}\" is of a contact and of a ligament of {}, expected names that differ",
          study_, name, scene_.file.string()));
    }
  }

  /// What a condition prescribes, swept or not, is known.
  [[nodiscard]] bool prescribed(std::size_t coordinate) const {
    return std::any_of(scene_.conditions.begin(), scene_.conditions.end(),
                       [&](const ConditionDescription& condition) {
                         // The first six kinds are joint coordinates.
                         return static_cast<std::size_t>(condition.kind) == coordinate;
                       });
  }

  bool add_joint(const std::string& what) {
    bool found = false;
    for (std::size_t i = 0; scene_.joint && i < kJointCoordinates.size(); ++i) {
      const JointCoordinate& q = kJointCoordinates[i];
      if (what.empty() ? prescribed(i) : what != q.name) continue;
      found = true;
      keep(q.name, q.angle ? kDegree : kMillimetre, {OutputKind::kJointCoordinate, i});
    }
    return found;
  }

  bool add_of_contact(std::size_t i, const std::string& what) {
    const std::string& name = scene_.contacts[i].name;
    if (what == "force") {
      keep(name + ".force", kNewton, {OutputKind::kContactForce, i});
      return true;
    }
    constexpr const char* kAxes[] = {"x", "y", "z"};
    for (int c = 0; what == "point" && c < 3; ++c)
      keep(fmt::format("{}.point.{}", name, kAxes[c]), kMillimetre,
           {OutputKind::kContactResultant, i, c});
    return what == "point";
  }

  bool add_of_contacts(const std::string& what) {
    bool found = false;
    for (std::size_t i = 0; i < scene_.contacts.size(); ++i) found |= add_of_contact(i, what);
    return found;
  }

  bool add_of_ligament(std::size_t i, const std::string& what) {
    for (const LigamentWord& known : kOfLigament) {
      if (what != known.word) continue;
      keep(fmt::format("{}.{}", scene_.ligaments[i].name, what), known.unit, {known.kind, i});
      return true;
    }
    return false;
  }

  bool add_of_ligaments(const std::string& what) {
    bool found = false;
    for (std::size_t i = 0; i < scene_.ligaments.size(); ++i) found |= add_of_ligament(i, what);
    return found;
  }

  bool add_of_one(const std::string& owner, const std::string& what) {
    bool found = false;
    for (std::size_t i = 0; i < scene_.contacts.size(); ++i)
      if (scene_.contacts[i].name == owner) found |= add_of_contact(i, what);
    for (std::size_t i = 0; i < scene_.ligaments.size(); ++i)
      if (scene_.ligaments[i].name == owner) found |= add_of_ligament(i, what);
    return found;
  }

  [[noreturn]] void refuse(const std::string& word) const {
    std::string names;
    for (const ContactDescription& contact : scene_.contacts) names += contact.name + ", ";
    for (const LigamentDescription& ligament : scene_.ligaments) names += ligament.name + ", ";
    throw InputError(fmt::format(
        "{}: outputs: \"{}\", expected \"joint\" or \"joint.anterior_drawer\" (of a scene with "
        "[joint]), \"contact.force\", \"contact.point\", \"ligament.force\", \"ligament.strain\", "
        "\"ligament.length\", or one of {}with one of these words behind a dot",
        study_, word, names));
  }

  const Scene& scene_;
  const std::string& study_;
};

/// "contact.force" is that of all contacts, and of a ligament called "contact".
void expect_one_meaning(const std::string& word, const Scene& scene, const std::string& study) {
  const auto is_named = [](const auto& all, const char* name) {
    return std::any_of(all.begin(), all.end(),
                       [name](const auto& one) { return one.name == name; });
  };
  const bool contact = word == "contact.force" && is_named(scene.ligaments, "contact"),
             ligament = word == "ligament.force" && is_named(scene.contacts, "ligament");
  if (!contact && !ligament) return;
  const char* named = contact ? "ligament" : "contact";
  throw InputError(fmt::format(
      "{}: outputs: \"{}\" is that of all {}s and of a {} of that name in {}, expected another "
      "name of "
      "the {}",
      study, word, contact ? "contact" : "ligament", named, scene.file.string(), named));
}

}  // namespace

std::vector<StudyOutput> study_outputs(const Scene& scene,
                                       const std::vector<std::string>& words,
                                       const std::string& study) {
  OutputList list(scene, study);
  if (!words.empty()) {
    for (const std::string& word : words) {
      expect_one_meaning(word, scene, study);
      list.add(word);
    }
    return list.outputs;
  }
  if (scene.joint) list.add("joint");
  if (!scene.contacts.empty()) list.add("contact.force");
  if (!scene.ligaments.empty()) list.add("ligament.force");
  return list.outputs;
}

}  // namespace condyle
