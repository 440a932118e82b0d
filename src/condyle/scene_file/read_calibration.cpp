/// [calibrate]: the table of measurements, what the names in it mean, how far it is trusted, and which
/// numbers of the knee are free.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "condyle/scene_file/read_numbers.h"
#include "condyle/scene_file/read_sections.h"

namespace condyle {
namespace {

double read_moment_unit(const Section& section, const Scene& scene) {
  static const Choices<double> moments = {{"N m", 1000}, {"N cm", 10}, {"N mm", 1}};
  return section.has("moment") ? section.choice("moment", moments)
                               : scene.force_to_n * scene.length_to_mm;
}

std::vector<std::string> read_relative(const Section& section) {
  const std::string expected = "names of curves of the table [\"ap30\", ...]";
  const Value& list = section.value("relative", expected);
  if (list.type != Value::Type::kArray) section.fail("relative", expected);
  std::vector<std::string> curves;
  for (const Value& item : list.items) {
    if (item.type != Value::Type::kText || item.text.empty())
      section.fail("relative", item, "the name of a curve of the table");
    if (std::find(curves.begin(), curves.end(), item.text) != curves.end())
      section.fail("relative", item, "each curve once");
    curves.push_back(item.text);
  }
  return curves;
}

/// [length, angle], each >= 0 and not both 0, in mm and rad.
std::array<double, 2> read_deviations(const Section& section,
                                      const std::string& key,
                                      const Scene& scene) {
  const std::string expected = "two standard deviations [length, angle] >= 0, one of them > 0";
  const std::vector<double> both = section.numbers(key, expected);
  if (both.size() != 2 || !(std::min(both[0], both[1]) >= 0) || !(std::max(both[0], both[1]) > 0))
    section.fail(key, expected);
  return {both[0] * scene.length_to_mm, both[1] * scene.angle_to_rad};
}

void read_frames(const Section& section, const Scene& scene, CalibrationDescription& calibration) {
  const Section frames =
      section.table("frame_sd", "a table { femur = [length, angle], tibia = [length, angle] }");
  if (frames.has("femur")) calibration.femur_frame_sd = read_deviations(frames, "femur", scene);
  if (frames.has("tibia")) calibration.tibia_frame_sd = read_deviations(frames, "tibia", scene);
  frames.finish();
}

double whole_number_or(const Section& section, const char* key, int least, int otherwise) {
  constexpr double kMost = 1e6;
  if (!section.has(key)) return otherwise;
  const std::string expected = fmt::format("a whole number from {} to {:.0f}", least, kMost);
  const double number = section.number(key, expected);
  if (number != std::floor(number) || number < least || number > kMost) section.fail(key, expected);
  return number;
}

void read_nuisance(const Section& section,
                   const Scene& scene,
                   CalibrationDescription& calibration) {
  if (section.has("curve_sd")) calibration.curve_sd = read_deviations(section, "curve_sd", scene);
  if (section.has("frame_sd")) read_frames(section, scene, calibration);
  constexpr double kHalfTurn = std::numbers::pi;
  calibration.flexion_sd =
      scene.angle_to_rad * section.number_or("flexion_sd", 0, "an angle", Range::kNotNegative);
  if (calibration.flexion_sd > kHalfTurn)
    section.fail("flexion_sd", "an angle of at most half a turn");
  calibration.level_sd =
      section.number_or("level_sd", 0, "a part of the level, 0.02 for 2 %", Range::kNotNegative);
  if (calibration.level_sd >= 1)
    section.fail("level_sd", "a part of the level below 1, 0.02 for 2 %");
}

void read_search(const Section& section, CalibrationDescription& calibration) {
  if (section.has("huber")) {
    constexpr double kLeast =
        1e-3;  // below it is as good as absolute values, until roots of it vanish
    calibration.huber =
        section.number("huber", "a number of standard deviations", Range::kPositive);
    if (*calibration.huber < kLeast)
      section.fail("huber", fmt::format("a number of standard deviations >= {}", kLeast));
  }
  calibration.starts = static_cast<int>(whole_number_or(section, "starts", 1, calibration.starts));
  calibration.seed = static_cast<unsigned>(
      whole_number_or(section, "seed", 0, static_cast<int>(calibration.seed)));
  calibration.samples =
      static_cast<int>(whole_number_or(section, "samples", 0, calibration.samples));
}

CalibrationLoad read_tested_load(const Section& section,
                                 const Scene& scene,
                                 const CalibrationDescription& calibration) {
  CalibrationLoad tested;
  tested.name = read_name(section, names_of(calibration.loads));
  if (tested.name == "none") section.fail("name", "another name: none is the unloaded knee");
  tested.displacement_control = section.has("condition");
  if (section.has("load") == tested.displacement_control)
    section.fail_with(tested.displacement_control ? "has load and condition, expected one of them"
                                                  : "has neither load nor condition, expected one");
  const char* key = tested.displacement_control ? "condition" : "load";
  tested.index = tested.displacement_control
                     ? section.reference(key, "the name of a condition", names_of(scene.conditions))
                     : section.reference(key, "the name of a load", names_of(scene.loads));
  if (tested.displacement_control && tested.index == calibration.flexion)
    section.fail(key, "a condition other than that of flexion, which every test prescribes");
  const auto index = static_cast<std::size_t>(tested.index);
  if (!tested.displacement_control && !(scene.loads[index].vector.norm() > 0))
    section.fail(key, "a load whose vector is not 0: the level acts along it");
  section.finish();
  return tested;
}

/// A test says how large its load is: a factor on it would be gone from the fitted scene.
void refuse_sizes_of_tests(const Section& section,
                           const Scene& scene,
                           const CalibrationDescription& calibration) {
  for (const CalibrationParameter& parameter : calibration.parameters)
    for (const CalibrationLoad& load : calibration.loads)
      if (parameter.what == ParameterKind::kLoadScale && !load.displacement_control &&
          std::find(parameter.of.begin(), parameter.of.end(), load.index) != parameter.of.end())
        section.fail_with(fmt::format(
            "fits the size of load \"{}\", which [[calibrate.load]] \"{}\" takes from the table, "
            "expected a load that no test sets (level_sd says how far levels are trusted)",
            scene.loads[static_cast<std::size_t>(load.index)].name, load.name));
}

}  // namespace

std::vector<CalibrationParameter> read_fitted_numbers(const Section& calibrate,
                                                      const Scene& scene) {
  std::vector<CalibrationParameter> parameters;
  NamedNumbers named;
  for (const Section& section : calibrate.sections("parameter")) {
    CalibrationParameter parameter = read_named_numbers(section, scene, named);
    read_deviation(section, scene, "prior_sd", "a standard deviation of the prior", parameter);
    read_bounds(section, scene, parameter);
    section.finish();
    parameters.push_back(parameter);
  }
  if (parameters.empty())
    calibrate.fail_with("has no [[calibrate.parameter]], expected one or more numbers to fit");
  return parameters;
}

void read_calibration(const Section& root, Scene& scene) {
  if (!root.has("calibrate")) return;
  const Section section =
      root.table("calibrate", "a table [calibrate] with measurements, and parameters");
  CalibrationDescription calibration;
  calibration.measurements =
      section.source().folder / section.text("measurements", "the path of a table (CSV)");
  if (section.has("specimen")) calibration.specimen = section.text("specimen", "a specimen's name");
  calibration.flexion = flexion_condition(scene);
  if (calibration.flexion < 0)
    section.fail_with("needs a [[condition]] of kind \"flexion\" that a test prescribes");
  calibration.moment_to_nmm = read_moment_unit(section, scene);
  if (section.has("relative")) calibration.relative = read_relative(section);
  read_nuisance(section, scene, calibration);
  read_search(section, calibration);
  for (const Section& load : section.sections("load"))
    calibration.loads.push_back(read_tested_load(load, scene, calibration));
  calibration.parameters = read_fitted_numbers(section, scene);
  refuse_sizes_of_tests(section, scene, calibration);
  section.finish();
  scene.calibration = calibration;
}

}  // namespace condyle
