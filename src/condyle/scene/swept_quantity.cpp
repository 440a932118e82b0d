#include "condyle/scene/swept_quantity.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "condyle/scene/usable_number.h"

namespace condyle {
namespace {

const Unit kDegrees = {"deg", M_PI / 180};

/// The title where a kind of condition has one of its own; others go by their names.
const char* title_of(ConditionKind kind) {
  switch (kind) {
    case ConditionKind::kFlexion:
      return "Flexion";
    case ConditionKind::kAdduction:
      return "Adduction";
    case ConditionKind::kInternalRotation:
      return "Internal rotation";
    case ConditionKind::kLateralShift:
      return "Lateral shift";
    case ConditionKind::kAnteriorDrawer:
      return "Anterior drawer";
    case ConditionKind::kDistraction:
      return "Distraction";
    default:
      return nullptr;
  }
}

std::string without_capital(std::string text) {
  text[0] = static_cast<char>(text[0] - 'A' + 'a');
  return text;
}

Unit declared_length(const Scene& scene) {
  const double to_mm = scene.length_to_mm;
  return {to_mm == 1 ? "mm" : to_mm == 10 ? "cm" : "m", to_mm};
}

void take_condition(const Scene& scene, SweptQuantity& swept) {
  const ConditionDescription& condition =
      scene.conditions.at(static_cast<std::size_t>(swept.condition));
  const bool angle = is_angle(condition.kind);
  const char* title = title_of(condition.kind);
  swept.title = title != nullptr ? title : condition.name;
  swept.inside = title != nullptr ? without_capital(title) : condition.name;
  swept.symbol = angle ? "°" : "mm";
  swept.unit = angle ? kDegrees : Unit{"mm", 1};
  swept.declared = !angle ? declared_length(scene)
                          : Unit{scene.angle_to_rad == 1 ? "rad" : "deg", scene.angle_to_rad};
  swept.flexion = condition.kind == ConditionKind::kFlexion;
  swept.axis = swept.title + " [" + swept.symbol + "]";
  swept.axis_per_inside = 1 / swept.unit.factor;
}

void take_load(const Scene& scene, SweptQuantity& swept) {
  const LoadDescription& load = scene.loads.at(static_cast<std::size_t>(swept.load));
  const double size = load.vector.norm();
  swept.title = "Factor on " + load.name;
  swept.inside = "factor on " + load.name;
  swept.symbol = "×";
  swept.axis = size > 0 ? load.name + (load.moment ? " [N mm]" : " [N]") : swept.title;
  swept.axis_per_inside = size > 0 ? size : 1;
}

}  // namespace

std::string SweptQuantity::unit_after_number() const {
  return unit.name == "1" ? "" : " " + unit.name;
}

std::string SweptQuantity::heading() const {
  return unit.name == "1" ? name : fmt::format("{} [{}]", name, unit.name);
}

SweptQuantity quantity_of_sweep(const Scene& scene) {
  SweptQuantity swept;
  if (!scene.sweep) return swept;
  swept.name = scene.sweep->vary;
  (scene.sweep->varies_load ? swept.load : swept.condition) = scene.sweep->index;
  if (swept.load >= 0) take_load(scene, swept);
  if (swept.condition >= 0) take_condition(scene, swept);
  return swept;
}

SweptQuantity quantity_of_motion() {
  const Unit seconds = {"s", 1};
  return {.name = "time",
          .title = "Time",
          .inside = "time",
          .symbol = "s",
          .unit = seconds,
          .declared = seconds,
          .axis = "Time [s]"};
}

namespace {

bool go_one_way(const std::vector<double>& values) {
  return std::adjacent_find(values.begin(), values.end(), std::greater_equal<>()) == values.end() ||
         std::adjacent_find(values.begin(), values.end(), std::less_equal<>()) == values.end();
}

}  // namespace

std::string fault_of_values(const Scene& scene) {
  const SweepDescription& sweep = *scene.sweep;
  if (sweep.arc_length && !go_one_way(sweep.values))
    return "values that turn back, expected such as go one way with path = \"arc length\": it goes "
           "from the first to "
           "the last";
  if (sweep.varies_load) return {};
  const ConditionKind kind = scene.conditions[static_cast<std::size_t>(sweep.index)].kind;
  const auto [least, most] = std::minmax_element(sweep.values.begin(), sweep.values.end());
  if (kind == ConditionKind::kDistance && *least <= 0)
    return "values down to 0 and below, expected distances > 0";
  const bool turns = is_angle(kind) && !(is_usable_angle(*least) && is_usable_angle(*most));
  return turns ? "values beyond one turn, expected angles of at most that (suspect [units] angle)"
               : "";
}

std::string with_unit(const SweptQuantity& quantity, double value) {
  // Rounded first, so that -0.04 does not read "-0".
  const double digits = quantity.symbol == "s" ? 1e4 : quantity.symbol == "×" ? 1e3 : 10;
  const double rounded = std::round(digits * quantity.shown(value)) / digits + 0.0;
  const bool apart = quantity.symbol == "mm" || quantity.symbol == "s";
  return fmt::format("{:g}{}{}", rounded, apart ? " " : "", quantity.symbol);
}

}  // namespace condyle
