/// How far the numbers of a [[calibrate.parameter]] or a [[vary]] may be from those of the scene.

#include <fmt/format.h>

#include <cmath>

#include "condyle/scene/ligament_number.h"
#include "condyle/scene_file/read_numbers.h"

namespace condyle {
namespace {

/// Whether changes are told as a factor on the scene's value.
bool by_factor(const CalibrationParameter& parameter) {
  return parameter.what == ParameterKind::kLoadScale || parameter.what == ParameterKind::kStiffness;
}

bool is_move(const CalibrationParameter& parameter) {
  return parameter.what == ParameterKind::kInsertion;
}

/// What one of a parameter's lengths is in mm.
double length_unit(const Scene& scene, const CalibrationParameter& parameter) {
  const bool length = parameter.what == ParameterKind::kSlackLength || is_move(parameter);
  return length ? scene.length_to_mm : 1;
}

/// A standard deviation, in mm or 1.
double deviation(const Section& section,
                 const std::string& key,
                 const std::string& meaning,
                 double unit) {
  constexpr double kLeast = 1e-9, kMost = 1e9;
  const double sd = unit * section.number(key, meaning, Range::kPositive);
  if (sd < kLeast || sd > kMost)
    section.fail(key,
                 fmt::format("{} from {:.3g} to {:.3g}", meaning, kLeast / unit, kMost / unit));
  return sd;
}

/// Of the scene's own value of a number, as bounds are told: 1 of a factor, 0 of a move.
double own_number(const Scene& scene, const CalibrationParameter& parameter, int index) {
  if (by_factor(parameter)) return 1;
  if (is_move(parameter)) return 0;
  return number_of(scene, scene.ligaments[static_cast<std::size_t>(index)], parameter.what);
}

/// What a lowest value should have been; empty where it can be.
std::string lower_limit(const CalibrationParameter& parameter, double lower) {
  if (is_move(parameter)) return {};
  const bool strain = parameter.what == ParameterKind::kReferenceStrain;
  if (strain) return lower > -1 ? "" : "strains > -1";
  return lower > 0 ? "" : "bounds > 0";
}

std::array<double, 2> two_numbers(const Section& section, const std::string& key) {
  const std::string expected = "two numbers [lower, upper], the lower one first";
  const std::vector<double> both = section.numbers(key, expected);
  if (both.size() != 2 || !(both[0] < both[1])) section.fail(key, expected);
  return {both[0], both[1]};
}

}  // namespace

void read_deviation(const Section& section,
                    const Scene& scene,
                    const std::string& key,
                    const std::string& meaning,
                    CalibrationParameter& parameter) {
  const double unit = length_unit(scene, parameter);
  parameter.prior_sd = deviation(section, key, meaning, unit);
  if (!section.has("normal_sd")) return;
  if (!is_move(parameter)) section.fail("normal_sd", "what = \"insertion.BODY\" beside it");
  parameter.normal_sd = deviation(section, "normal_sd", meaning, unit);
}

void read_bounds(const Section& section, const Scene& scene, CalibrationParameter& parameter) {
  if (!section.has("bounds")) return;
  const double unit = length_unit(scene, parameter);
  const std::array<double, 2> bounds = two_numbers(section, "bounds");
  if (const std::string limit = lower_limit(parameter, bounds[0]); !limit.empty())
    section.fail("bounds", limit);
  parameter.bounds = {unit * bounds[0], unit * bounds[1]};
  for (const int index : parameter.of) {
    const double own = own_number(scene, parameter, index);
    if (std::isnan(own) || (parameter.bounds->at(0) < own && own < parameter.bounds->at(1)))
      continue;
    if (by_factor(parameter))
      section.fail("bounds", "bounds of a factor on the scene's value, about 1");
    if (is_move(parameter)) section.fail("bounds", "bounds of a move, about 0");
    const std::string& name = scene.ligaments[static_cast<std::size_t>(index)].name;
    section.fail("bounds", fmt::format("bounds about the scene's own value, {:.6g} of \"{}\"",
                                       own / unit, name));
  }
}

std::array<double, 2> read_range(const Section& section,
                                 const Scene& scene,
                                 const CalibrationParameter& parameter) {
  const double unit = length_unit(scene, parameter);
  const std::array<double, 2> range = two_numbers(section, "range");
  if (is_move(parameter)) return {unit * range[0], unit * range[1]};
  if (by_factor(parameter)) {
    if (!(range[0] > 0)) section.fail("range", "factors on the scene's value, > 0");
    return range;
  }
  for (const int index : parameter.of) {
    const double own = own_number(scene, parameter, index);
    if (std::isnan(own) || lower_limit(parameter, own + unit * range[0]).empty()) continue;
    const std::string& name = scene.ligaments[static_cast<std::size_t>(index)].name;
    const double limit = parameter.what == ParameterKind::kReferenceStrain ? -1 : 0;
    section.fail("range",
                 fmt::format("changes to numbers > {:g}: the scene's own is {:.6g} of \"{}\"",
                             limit, own / unit, name));
  }
  return {unit * range[0], unit * range[1]};
}

}  // namespace condyle
