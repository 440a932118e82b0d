#include "pictures/swept_quantity.h"

#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <numbers>

namespace condyle {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

SweptQuantity quantity_of(const ConditionDescription& condition) {
  switch (condition.kind) {
    case ConditionKind::kFlexion:
      return {"Flexion", "°", kDegrees, true};
    case ConditionKind::kAdduction:
      return {"Adduction", "°", kDegrees};
    case ConditionKind::kInternalRotation:
      return {"Internal rotation", "°", kDegrees};
    case ConditionKind::kLateralShift:
      return {"Lateral shift", "mm", 1};
    case ConditionKind::kAnteriorDrawer:
      return {"Anterior drawer", "mm", 1};
    case ConditionKind::kDistraction:
      return {"Distraction", "mm", 1};
    case ConditionKind::kTranslation:
      return {condition.name, "mm", 1};
    case ConditionKind::kRotation:
      return {condition.name, "°", kDegrees};
    case ConditionKind::kDistance:
      return {condition.name, "mm", 1};
  }
  return {condition.name, "", 1};
}

}  // namespace

SweptQuantity swept_quantity(const Scene& scene) {
  if (scene.simulation) return {"Time", "s", 1};
  if (!scene.sweep || scene.sweep->index < 0) return {"Pose", "", 1};
  const auto index = static_cast<std::size_t>(scene.sweep->index);
  if (scene.sweep->varies_load) {
    return {index < scene.loads.size() ? "Factor on " + scene.loads[index].name : scene.sweep->vary,
            "×", 1};
  }
  if (index >= scene.conditions.size()) return {scene.sweep->vary, "", 1};
  return quantity_of(scene.conditions[index]);
}

std::string SweptQuantity::inside_a_line() const {
  for (const char* known : {"Time", "Factor on ", "Flexion", "Adduction", "Internal rotation",
                            "Lateral shift", "Anterior drawer", "Distraction", "Pose"}) {
    if (title.rfind(known, 0) != 0) continue;
    std::string text = title;
    text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
    return text;
  }
  return title;
}

std::string with_unit(const SweptQuantity& quantity, double inside) {
  // Rounded first, so that -0.04 does not read "-0".
  const double digits = quantity.unit == "s" ? 1e4 : quantity.unit == "×" ? 1e3 : 10;
  const double rounded = std::round(digits * quantity.shown(inside)) / digits + 0.0;
  const bool apart = quantity.unit == "mm" || quantity.unit == "s";
  return fmt::format("{:g}{}{}", rounded, apart ? " " : "", quantity.unit);
}

}  // namespace condyle
