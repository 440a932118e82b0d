#include "condyle/exchange/jcs_heading.h"

#include <array>
#include <string_view>

namespace condyle {
namespace {

struct Words {
  std::string text, unit;
};

/// "Knee JCS Medial [mm]" or "Knee JCS Medial(mm)": what stands before the unit, and the unit.
Words split(const std::string& heading) {
  const std::size_t open = heading.find_last_of("[(");
  if (open == std::string::npos || heading.empty() ||
      (heading.back() != ']' && heading.back() != ')'))
    return {heading, ""};
  std::string text = heading.substr(0, open);
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return {text, heading.substr(open + 1, heading.size() - open - 2)};
}

struct MotionWord {
  std::string_view word;
  std::size_t coordinate;
  double sign;
};
// Coordinates as in joint_table.h: flexion, adduction, internal rotation, lateral shift, anterior
// drawer, distraction.
constexpr std::array<MotionWord, 12> kMotions = {{{"Flexion", 0, 1},
                                                  {"Extension", 0, -1},
                                                  {"Varus", 1, 1},
                                                  {"Valgus", 1, -1},
                                                  {"Internal Rotation", 2, 1},
                                                  {"External Rotation", 2, -1},
                                                  {"Lateral", 3, 1},
                                                  {"Medial", 3, -1},
                                                  {"Anterior", 4, 1},
                                                  {"Posterior", 4, -1},
                                                  {"Inferior", 5, 1},
                                                  {"Superior", 5, -1}}};

struct LoadWord {
  std::string_view word, name;
  bool moment;
};
constexpr std::array<LoadWord, 12> kLoads = {{{"Lateral Drawer", "lateral", false},
                                              {"Medial Drawer", "medial", false},
                                              {"Anterior Drawer", "anterior", false},
                                              {"Posterior Drawer", "posterior", false},
                                              {"Distraction", "distraction", false},
                                              {"Compression", "compression", false},
                                              {"Extension Torque", "extension", true},
                                              {"Flexion Torque", "flexion", true},
                                              {"Varus Torque", "varus", true},
                                              {"Valgus Torque", "valgus", true},
                                              {"External Rotation Torque", "external", true},
                                              {"Internal Rotation Torque", "internal", true}}};

bool is_moment(const std::string& unit) { return unit == "Nm" || unit == "N m" || unit == "N.m"; }

}  // namespace

std::optional<JcsMotion> motion_of_heading(const std::string& heading) {
  constexpr std::string_view kStart = "Knee JCS ";
  const Words words = split(heading);
  if (!words.text.starts_with(kStart)) return std::nullopt;
  for (const MotionWord& known : kMotions)
    if (words.text.substr(kStart.size()) == known.word &&
        words.unit == (known.coordinate < 3 ? "deg" : "mm"))
      return JcsMotion{known.coordinate, known.sign, std::string(known.word)};
  return std::nullopt;
}

std::optional<JcsLoad> load_of_heading(const std::string& heading) {
  constexpr std::string_view kStart = "JCS Load ";
  const Words words = split(heading);
  if (!words.text.starts_with(kStart)) return std::nullopt;
  for (const LoadWord& known : kLoads)
    if (words.text.substr(kStart.size()) == known.word &&
        (known.moment ? is_moment(words.unit) : words.unit == "N"))
      return JcsLoad{std::string(known.name), known.moment};
  return std::nullopt;
}

std::optional<JcsDriven> driven_of_heading(const std::string& heading) {
  const Words words = split(heading);
  if (words.text == "Flexion Angle" && words.unit == "deg") return JcsDriven::kFlexion;
  if (words.text != "Applied Load") return std::nullopt;
  if (words.unit == "N") return JcsDriven::kForce;
  return is_moment(words.unit) ? std::optional<JcsDriven>(JcsDriven::kMoment) : std::nullopt;
}

}  // namespace condyle
