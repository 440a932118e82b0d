/// [[calibrate.parameter]]: which numbers of the knee are free, and their priors.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "condyle/scene/ligament_number.h"
#include "condyle/scene_file/read_sections.h"

namespace condyle {
namespace {

/// What is free so far, and on which line that was said: a slack length and its reference strain are
/// one number.
using FreeNumbers = std::map<std::tuple<ParameterKind, int, int>, int>;

constexpr const char* kOf = "names [\"aACL\", ...], prefixes [\"ACL*\"], or \"*\" for all";

void read_what(const Section& section, const Scene& scene, CalibrationParameter& parameter) {
  Choices<std::pair<ParameterKind, int>> kinds;
  for (const ParameterKind kind : kNumbersOfLaws) kinds.push_back({word_of(kind), {kind, -1}});
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    kinds.push_back(
        {"insertion." + scene.bodies[i].name, {ParameterKind::kInsertion, static_cast<int>(i)}});
  kinds.push_back({"load", {ParameterKind::kLoadScale, -1}});
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
               FreeNumbers& taken) {
  const ParameterKind kind = parameter.what == ParameterKind::kSlackLength
                                 ? ParameterKind::kReferenceStrain
                                 : parameter.what;
  const auto [number, fresh] = taken.try_emplace({kind, index, parameter.body}, entry.line);
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
             FreeNumbers& taken) {
  const Value& of = section.value("of", kOf);
  const bool list = of.type == Value::Type::kArray && !of.items.empty();
  if (!list && of.type != Value::Type::kText) section.fail("of", kOf);
  const auto take = [&](const Value& entry) {
    for (const int index : meant_by(entry, section, scene, parameter))
      take_once(entry, index, section, scene, parameter, taken);
  };
  if (!list) return take(of);
  for (const Value& entry : of.items) take(entry);
}

/// What one of a parameter's lengths is in mm.
double length_unit(const Scene& scene, const CalibrationParameter& parameter) {
  const bool length =
      parameter.what == ParameterKind::kSlackLength || parameter.what == ParameterKind::kInsertion;
  return length ? scene.length_to_mm : 1;
}

/// A standard deviation of the prior, in mm or 1.
double prior_sd(const Section& section, const std::string& key, double unit) {
  constexpr double kLeast = 1e-9, kMost = 1e9;
  const double sd =
      unit * section.number(key, "a standard deviation of the prior", Range::kPositive);
  if (sd < kLeast || sd > kMost)
    section.fail(key, fmt::format("a standard deviation of the prior from {:.3g} to {:.3g}",
                                  kLeast / unit, kMost / unit));
  return sd;
}

void read_prior(const Section& section, const Scene& scene, CalibrationParameter& parameter) {
  const double unit = length_unit(scene, parameter);
  parameter.prior_sd = prior_sd(section, "prior_sd", unit);
  if (section.has("together")) parameter.together = section.boolean("together");
  if (!section.has("normal_sd")) return;
  if (parameter.what != ParameterKind::kInsertion)
    section.fail("normal_sd", "what = \"insertion.BODY\" beside it");
  parameter.normal_sd = prior_sd(section, "normal_sd", unit);
}

/// Of the scene's own value of a number, as bounds are told: 1 of a factor, 0 of a move.
double own_number(const Scene& scene, const CalibrationParameter& parameter, int index) {
  if (is_load(parameter) || parameter.what == ParameterKind::kStiffness) return 1;
  if (parameter.what == ParameterKind::kInsertion) return 0;
  return number_of(scene, scene.ligaments[static_cast<std::size_t>(index)], parameter.what);
}

/// The lowest value that a number can have, and whether it can have that.
std::string lower_limit(const CalibrationParameter& parameter, double lower) {
  if (parameter.what == ParameterKind::kInsertion) return {};
  const bool strain = parameter.what == ParameterKind::kReferenceStrain;
  if (strain) return lower > -1 ? "" : "strains > -1";
  return lower > 0 ? "" : "bounds > 0";
}

void read_bounds(const Section& section, const Scene& scene, CalibrationParameter& parameter) {
  if (!section.has("bounds")) return;
  const double unit = length_unit(scene, parameter);
  const std::string expected = "two numbers [lower, upper], the lower one first";
  const std::vector<double> bounds = section.numbers("bounds", expected);
  if (bounds.size() != 2 || !(bounds[0] < bounds[1])) section.fail("bounds", expected);
  if (const std::string limit = lower_limit(parameter, bounds[0]); !limit.empty())
    section.fail("bounds", limit);
  parameter.bounds = {unit * bounds[0], unit * bounds[1]};
  for (const int index : parameter.of) {
    const double own = own_number(scene, parameter, index);
    if (std::isnan(own) || (parameter.bounds->at(0) < own && own < parameter.bounds->at(1)))
      continue;
    if (is_load(parameter) || parameter.what == ParameterKind::kStiffness)
      section.fail("bounds", "bounds of a factor on the scene's value, about 1");
    if (parameter.what == ParameterKind::kInsertion)
      section.fail("bounds", "bounds of a move, about 0");
    const std::string& name = scene.ligaments[static_cast<std::size_t>(index)].name;
    section.fail("bounds", fmt::format("bounds about the scene's own value, {:.6g} of \"{}\"",
                                       own / unit, name));
  }
}

}  // namespace

std::vector<CalibrationParameter> read_fitted_numbers(const Section& calibrate,
                                                      const Scene& scene) {
  std::vector<CalibrationParameter> parameters;
  FreeNumbers taken;
  for (const Section& section : calibrate.sections("parameter")) {
    CalibrationParameter& parameter = parameters.emplace_back();
    read_what(section, scene, parameter);
    read_of(section, scene, parameter, taken);
    read_prior(section, scene, parameter);
    read_bounds(section, scene, parameter);
    section.finish();
  }
  if (parameters.empty())
    calibrate.fail_with("has no [[calibrate.parameter]], expected one or more numbers to fit");
  return parameters;
}

}  // namespace condyle
