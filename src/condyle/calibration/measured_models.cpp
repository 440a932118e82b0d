#include "condyle/calibration/measured_models.h"

#include <algorithm>

namespace condyle {
namespace {

std::vector<int> conditions_of_tests(const CalibrationDescription& calibration) {
  std::vector<int> held;
  for (const CalibrationLoad& load : calibration.loads)
    if (load.displacement_control && std::find(held.begin(), held.end(), load.index) == held.end())
      held.push_back(load.index);
  return held;
}

MeasuredModel model_that_holds(int condition, const std::vector<int>& of_tests, const Model& all) {
  Model model = all;
  model.conditions.clear();
  model.condition_names.clear();
  MeasuredModel measured;
  measured.held = condition;
  for (std::size_t i = 0; i < all.conditions.size(); ++i) {
    const int scene_index = static_cast<int>(i);
    const bool of_another = scene_index != condition && std::find(of_tests.begin(), of_tests.end(),
                                                                  scene_index) != of_tests.end();
    measured.conditions.push_back(of_another ? -1 : static_cast<int>(model.conditions.size()));
    if (of_another) continue;
    model.conditions.push_back(all.conditions[i]);
    model.condition_names.push_back(all.condition_names[i]);
  }
  measured.model = std::make_shared<const Model>(std::move(model));
  return measured;
}

}  // namespace

std::size_t MeasuredModels::that_holds(int condition) const {
  const auto found =
      std::find_if(models.begin(), models.end(),
                   [condition](const MeasuredModel& model) { return model.held == condition; });
  return static_cast<std::size_t>(found - models.begin());
}

MeasuredModels measured_models(const Scene& scene, const std::vector<FittedSurface>& surfaces) {
  const Model all = build_model(scene, surfaces);
  const std::vector<int> of_tests = conditions_of_tests(*scene.calibration);
  MeasuredModels result;
  result.covers = cover_pairs(all);
  result.models.push_back(model_that_holds(-1, of_tests, all));
  for (const int condition : of_tests)
    result.models.push_back(model_that_holds(condition, of_tests, all));
  return result;
}

}  // namespace condyle
