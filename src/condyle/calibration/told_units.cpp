#include "condyle/calibration/told_units.h"

#include "condyle/math/degree.h"

namespace condyle {
namespace {

bool is_strain(const FreeParameter& parameter) {
  if (parameter.moves.empty()) return false;
  const ParameterKind kind = parameter.moves.front().first.kind;
  return kind == ParameterKind::kReferenceStrain || kind == ParameterKind::kTransitionStrain;
}

}  // namespace

Unit unit_of_theta(const FreeParameter& parameter) {
  if (parameter.units == "rad") return {"deg", kDegree};
  return {parameter.units, 1};
}

Unit unit_for_people(const FreeParameter& parameter) {
  return is_strain(parameter) ? Unit{"%", 0.01} : unit_of_theta(parameter);
}

const CalibrationLoad* find_load(const Scene& scene, int load) {
  if (!scene.calibration || load < 0) return nullptr;
  const std::vector<CalibrationLoad>& loads = scene.calibration->loads;
  const auto i = static_cast<std::size_t>(load);
  return i < loads.size() ? &loads[i] : nullptr;
}

Unit unit_of_level(const Scene& scene, int load) {
  const CalibrationLoad* of = find_load(scene, load);
  if (of == nullptr || of->index < 0) return {"", 1};
  const auto i = static_cast<std::size_t>(of->index);
  if (of->displacement_control) {
    const bool angle = i < scene.conditions.size() && is_angle(scene.conditions[i].kind);
    return angle ? Unit{"deg", kDegree} : Unit{"mm", 1};
  }
  const bool moment = i < scene.loads.size() && scene.loads[i].moment;
  return moment ? Unit{"N m", 1000} : Unit{"N", 1};
}

}  // namespace condyle
