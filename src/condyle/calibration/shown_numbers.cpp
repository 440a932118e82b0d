#include "condyle/calibration/shown_numbers.h"

#include <fmt/format.h>

#include <cmath>

#include "condyle/calibration/told_units.h"
#include "condyle/math/degree.h"

namespace condyle {
namespace {

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
}

}  // namespace

std::string shown_name(const FreeParameter& parameter) { return shown_name(parameter.name); }

std::string shown_name(std::string name) {
  for (const auto& [from, to] : {std::pair{"reference_strain", "strain"}, {".", " "}, {"_", " "}})
    replace_all(name, from, to);
  return name;
}

std::vector<std::string> shown_names(const CalibrationResult& result) {
  std::vector<std::string> names;
  for (const FreeParameter& parameter : result.parameters) names.push_back(shown_name(parameter));
  return names;
}

std::string load_name(const Scene& scene, int load) {
  const CalibrationLoad* of = find_load(scene, load);
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
  return fmt::format("{:g}°", std::round(1e4 * angle / kDegree) / 1e4 + 0.0);
}

double shown_value(const FreeParameter& parameter, double theta) {
  if (parameter.logarithmic) return std::exp(theta);
  return (parameter.start + theta) / unit_for_people(parameter).factor;
}

std::string shown_axis(const FreeParameter& parameter) {
  if (parameter.logarithmic) return "factor [-]";
  return fmt::format("[{}]", shown_unit(unit_for_people(parameter).name));
}

std::string shown_deviation(const FreeParameter& parameter, double sd) {
  if (!std::isfinite(sd)) return "none";
  if (parameter.logarithmic) return fmt::format("{:.2g} of ln", sd);
  const Unit unit = unit_for_people(parameter);
  const std::string number = fmt::format("{:.2g}", sd / unit.factor);
  return unit.name == "1" ? number : number + " " + shown_unit(unit.name);
}

}  // namespace condyle
