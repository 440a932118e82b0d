#include "condyle/study/study_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "condyle/input_error.h"
#include "condyle/specimen/fit_surfaces.h"
#include "condyle/specimen/fit_wraps.h"
#include "condyle/study/study_table.h"

namespace condyle {
namespace {

/// A load that is not there stays so whatever its size is multiplied by.
void refuse_idle_load(const Scene& scene, const FreeParameter& number, const std::string& study) {
  for (const auto& [moved, factor] : number.moves) {
    if (moved.kind != ParameterKind::kLoadScale) continue;
    const bool swept = scene.sweep && scene.sweep->varies_load &&
                       scene.sweep->index == static_cast<int>(moved.index);
    if (scene.loads[moved.index].scale == 0 && !swept)
      throw InputError(
          fmt::format("{}: [[vary]] {}: load \"{}\" has scale = 0 in {}, expected another one for "
                      "its size to vary",
                      study, number.name, scene.loads[moved.index].name, scene.file.string()));
  }
}

/// The numbers of one knee, as FreeParameter has them; a range, of a factor told as such, becomes
/// bounds of θ.
std::vector<FreeParameter> numbers_of(const Scene& scene,
                                      const std::vector<FittedSurface>& surfaces,
                                      const std::vector<VariedNumber>& varied,
                                      const std::string& study) {
  std::vector<CalibrationParameter> asked;
  for (const VariedNumber& number : varied) asked.push_back(number.number);
  std::vector<FreeParameter> numbers =
      free_numbers(scene, asked, body_meshes(scene, surfaces),
                   fmt::format("{}: [[vary]] in {}:", study, scene.file.string()));
  for (const FreeParameter& number : numbers) refuse_idle_load(scene, number, study);
  for (FreeParameter& number : numbers) {
    const std::optional<std::array<double, 2>>& range = varied[number.asked].range;
    if (!range) continue;
    for (std::size_t i = 0; i < 2; ++i) {
      const double end = number.logarithmic ? std::log((*range)[i]) : (*range)[i];
      number.bounds[i] = i == 0 ? std::max(number.bounds[i], end) : std::min(number.bounds[i], end);
    }
    if (!(number.bounds[0] < number.bounds[1]))
      throw InputError(
          fmt::format("{}: [[vary]] {}: range = [{}, {}] leaves nothing, expected changes that the "
                      "number allows",
                      study, number.name, (*range)[0], (*range)[1]));
  }
  return numbers;
}

std::vector<StudyParameter> parameters_of(const std::vector<FreeParameter>& numbers,
                                          const std::vector<VariedNumber>& varied,
                                          const StudyDescription& study) {
  std::vector<StudyParameter> parameters;
  for (const FreeParameter& number : numbers) {
    Spread spread;
    spread.kind = varied[number.asked].range ? Spread::Kind::kUniform : Spread::Kind::kNormal;
    spread.sd = number.prior_sd;
    spread.bounds = number.bounds;
    parameters.push_back({number.name, number.units, number.logarithmic, spread});
  }
  if (study.roughness)
    parameters.push_back({"roughness.seed", "1", false, {Spread::Kind::kBits, 1, {0, 1}}});
  return parameters;
}

/// All knees have the numbers of the first; their bounds may be narrower, as of a transition strain.
void check_alike(const StudyKnee& knee, const StudyPlan& plan, const std::string& study) {
  const std::vector<FreeParameter>& first = plan.knees.front().parameters;
  bool same = knee.parameters.size() == first.size();
  for (std::size_t j = 0; same && j < first.size(); ++j)
    same = knee.parameters[j].name == first[j].name;
  if (!same)
    throw InputError(
        fmt::format("{}: {}: the numbers that vary are not those of {}, expected the "
                    "same of all specimens",
                    study, knee.scene.file.string(), plan.knees.front().scene.file.string()));
  for (std::size_t j = 0; j < first.size(); ++j)
    if (const double sd = knee.parameters[j].prior_sd;
        std::abs(sd - first[j].prior_sd) > 1e-12 * first[j].prior_sd)
      throw InputError(
          fmt::format("{}: [[vary]] {}: its sd is {:.6g} {} in {} and {:.6g} in {}, expected one "
                      "for all knees: scenes with one "
                      "unit of length",
                      study, first[j].name, first[j].prior_sd, first[j].units,
                      plan.knees.front().scene.file.string(), sd, knee.scene.file.string()));
}

/// Where the words of outputs stand.
std::string place_of_outputs(const StudyDescription& study) {
  const std::string file = study.file.string();
  return study.outputs_line > 0 ? fmt::format("{}:{}", file, study.outputs_line) : file;
}

/// Those of the first knee, by their names.
std::vector<StudyOutput> outputs_of(const StudyKnee& knee, const StudyPlan& plan) {
  const std::vector<StudyOutput> own =
      study_outputs(knee.scene, plan.study.outputs, place_of_outputs(plan.study));
  std::vector<StudyOutput> outputs;
  for (const StudyOutput& output : plan.outputs) {
    const auto found = std::find_if(own.begin(), own.end(), [&](const StudyOutput& candidate) {
      return candidate.name == output.name;
    });
    if (found == own.end())
      throw InputError(fmt::format("{}: {}: no {}, expected the outputs of {} in all specimens",
                                   place_of_outputs(plan.study), knee.scene.file.string(),
                                   output.name, plan.knees.front().scene.file.string()));
    outputs.push_back(*found);
  }
  return outputs;
}

/// Each point is a sample of each knee.
void expect_countable(const StudyPlan& plan) {
  constexpr std::uint64_t kMostSamples = std::uint64_t{1} << 53;
  if (plan.points > kMostSamples / plan.knees.size())
    throw InputError(fmt::format("{}: {} points of {} knees, expected at most 2^53 samples",
                                 plan.study.file.string(), plan.points, plan.knees.size()));
}

void set_points(const StudyDescription& study, StudyPlan& plan) {
  if (study.design == DesignKind::kTable) {
    if (study.table_holds_values && plan.knees.size() > 1)
      throw InputError(
          fmt::format("{}: {} holds values, expected changes from the scene where there "
                      "are several specimens",
                      study.file.string(), study.table.string()));
    std::vector<std::string> names;
    for (const StudyParameter& parameter : plan.parameters) names.push_back(parameter.name);
    const StudyKnee& first = plan.knees.front();
    plan.table = read_study_table(study, names, first.parameters, first.scene);
    plan.points = plan.table.size();
    return;
  }
  DesignOptions options;
  options.kind = study.design;
  options.dimensions = plan.parameters.size();
  options.points = static_cast<std::uint64_t>(study.samples);
  options.levels = study.levels;
  options.seed = study.seed;
  try {
    plan.design = std::make_shared<const SampleDesign>(options);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", study.file.string(), error.what()));
  }
  plan.points = plan.design->size();
}

}  // namespace

void StudyPlan::theta(std::uint64_t sample, std::vector<double>& theta) const {
  const std::uint64_t point = point_of(sample);
  if (!design) {
    theta = table[static_cast<std::size_t>(point)];
    return;
  }
  design->point(point, theta);
  const std::vector<FreeParameter>& own = knees[knee_of(sample)].parameters;
  for (std::size_t j = 0; j < parameters.size(); ++j) {
    Spread spread = parameters[j].spread;
    // Bounds are of the number itself, and where it stands differs between knees.
    if (j < own.size()) spread.bounds = own[j].bounds;
    theta[j] = quantile(spread, theta[j]);
  }
}

StudyPlan study_plan(ReadStudy study, const OnProgress& on_knee) {
  StudyPlan plan;
  plan.study = std::move(study.study);
  const std::string file = plan.study.file.string();
  const int knees = static_cast<int>(study.scenes.size());
  for (std::size_t i = 0; i < study.scenes.size(); ++i) {
    if (on_knee) on_knee(static_cast<int>(i), knees);
    StudyKnee& knee = plan.knees.emplace_back();
    knee.scene = std::move(study.scenes[i]);
    knee.name = knee.scene.file.stem().string();
    knee.surfaces = fit_surfaces(knee.scene);
    fit_wraps(knee.scene, knee.surfaces);
    knee.parameters = numbers_of(knee.scene, knee.surfaces, study.varied[i], file);
    check_alike(knee, plan, file);
  }
  if (on_knee) on_knee(knees, knees);
  const StudyKnee& first = plan.knees.front();
  plan.parameters = parameters_of(first.parameters, study.varied.front(), plan.study);
  plan.outputs = study_outputs(first.scene, plan.study.outputs, place_of_outputs(plan.study));
  for (StudyKnee& knee : plan.knees) knee.outputs = outputs_of(knee, plan);
  plan.values = first.scene.sweep->values;
  set_points(plan.study, plan);
  expect_countable(plan);
  return plan;
}

}  // namespace condyle
