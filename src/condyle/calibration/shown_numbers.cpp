#include "condyle/calibration/shown_numbers.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace condyle {
namespace {

constexpr double kOneDegree = std::numbers::pi / 180;
constexpr double kNewtonMetre = 1000;  // [N mm]

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
}

const CalibrationLoad* load_of(const Scene& scene, int load) {
  if (!scene.calibration || load < 0) return nullptr;
  const std::vector<CalibrationLoad>& loads = scene.calibration->loads;
  const auto i = static_cast<std::size_t>(load);
  return i < loads.size() ? &loads[i] : nullptr;
}

/// How much of θ is one of what it is shown in.
struct ShownUnit {
  std::string name;
  double inside;
};

ShownUnit unit_of_theta(const FreeParameter& parameter) {
  const auto strain = [](const auto& move) {
    return move.first.kind == ParameterKind::kReferenceStrain ||
           move.first.kind == ParameterKind::kTransitionStrain;
  };
  if (parameter.units == "rad") return {"°", kOneDegree};
  if (!parameter.moves.empty() && strain(parameter.moves.front())) return {"%", 0.01};
  return {shown_unit(parameter.units), 1};
}

}  // namespace

std::string shown_name(const FreeParameter& parameter) {
  std::string name = parameter.name;
  for (const auto& [from, to] : {std::pair{"reference_strain", "strain"}, {".", " "}, {"_", " "}})
    replace_all(name, from, to);
  return name;
}

std::vector<std::string> shown_names(const CalibrationResult& result) {
  std::vector<std::string> names;
  for (const FreeParameter& parameter : result.parameters) names.push_back(shown_name(parameter));
  return names;
}

LevelUnit level_unit(const Scene& scene, int load) {
  const CalibrationLoad* of = load_of(scene, load);
  if (of == nullptr || of->index < 0) return {"", 1};
  const auto i = static_cast<std::size_t>(of->index);
  if (of->displacement_control) {
    const bool angle = i < scene.conditions.size() && is_angle(scene.conditions[i].kind);
    return angle ? LevelUnit{"°", kOneDegree} : LevelUnit{"mm", 1};
  }
  const bool moment = i < scene.loads.size() && scene.loads[i].moment;
  return moment ? LevelUnit{"N m", kNewtonMetre} : LevelUnit{"N", 1};
}

std::string load_name(const Scene& scene, int load) {
  const CalibrationLoad* of = load_of(scene, load);
  return of == nullptr ? "no load" : of->name;
}

std::string with_minus(std::string text) {
  for (std::size_t at = 0; at + 1 < text.size(); ++at)
    if (text[at] == '-' && text[at + 1] >= '0' && text[at + 1] <= '9' &&
        (at == 0 || text[at - 1] == ' '))
      text.replace(at, 1, "−");
  return text;
}

std::string shown_unit(const std::string& units) {
  if (units == "deg") return "°";
  return units == "1" ? "-" : units;
}

std::string shown_degrees(double angle) {
  return fmt::format("{:g}°", std::round(1e4 * angle / kOneDegree) / 1e4 + 0.0);
}

double shown_value(const FreeParameter& parameter, double theta) {
  if (parameter.logarithmic) return std::exp(theta);
  return (parameter.start + theta) / unit_of_theta(parameter).inside;
}

std::string shown_axis(const FreeParameter& parameter) {
  if (parameter.logarithmic) return "factor [-]";
  return fmt::format("[{}]", unit_of_theta(parameter).name);
}

std::string shown_deviation(const FreeParameter& parameter, double sd) {
  if (!std::isfinite(sd)) return "none";
  if (parameter.logarithmic) return fmt::format("{:.2g} of ln", sd);
  const ShownUnit unit = unit_of_theta(parameter);
  const std::string number = fmt::format("{:.2g}", sd / unit.inside);
  return unit.name == "-" ? number : number + " " + unit.name;
}

}  // namespace condyle
