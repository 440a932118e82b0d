#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "condyle/input_error.h"
#include "condyle/scene/start_pose.h"
#include "condyle/scene/swept_quantity.h"
#include "condyle/scene/usable_number.h"
#include "condyle/scene_file/read_scene_numbers.h"
#include "condyle/scene_file/read_sections.h"

namespace condyle {
namespace {

int read_letter(const Section& section) {
  static const Choices<int> letters = {{"x", 0}, {"y", 1}, {"z", 2}};
  return section.choice("axis", letters);
}

Eigen::Vector3d read_translation_axis(const Section& section) {
  const Value& value = section.value("axis", "a direction [x, y, z] in the ground frame");
  if (value.type == Value::Type::kText) return Eigen::Vector3d::Unit(read_letter(section));
  const Eigen::Vector3d axis = section.vector("axis", "a direction in the ground frame");
  if (!(axis.norm() > 1e-12)) section.fail("axis", "a direction of some length");
  return axis.normalized();
}

ConditionDescription read_condition(const Section& section, const Scene& scene) {
  static const Choices<ConditionKind> kinds = {
      {"flexion", ConditionKind::kFlexion},
      {"adduction", ConditionKind::kAdduction},
      {"internal_rotation", ConditionKind::kInternalRotation},
      {"lateral_shift", ConditionKind::kLateralShift},
      {"anterior_drawer", ConditionKind::kAnteriorDrawer},
      {"distraction", ConditionKind::kDistraction},
      {"translation", ConditionKind::kTranslation},
      {"rotation", ConditionKind::kRotation},
      {"distance", ConditionKind::kDistance}};
  ConditionDescription condition;
  condition.name = read_name(section, names_of(scene.conditions));
  condition.kind = section.choice("kind", kinds);
  const bool distance = condition.kind == ConditionKind::kDistance;
  condition.value =
      is_angle(condition.kind)
          ? read_angle(section, "value", scene)
          : scene.length_to_mm *
                section.number("value", "a length", distance ? Range::kPositive : Range::kAny);
  if (condition.kind == ConditionKind::kTranslation) {
    condition.axis = read_translation_axis(section);
  } else if (condition.kind == ConditionKind::kRotation) {
    condition.cardan_axis = read_letter(section);
  } else if (distance) {
    condition.ends = read_ends(section, scene);
  } else if (!scene.joint) {
    section.fail("kind", "a [joint] that says where the anatomical frames are");
  }
  section.finish();
  return condition;
}

LoadDescription read_load(const Section& section, const Scene& scene) {
  static const Choices<bool> kinds = {{"force", false}, {"moment", true}};
  static const Choices<bool> frames = {{"ground", false}, {"body", true}};
  LoadDescription load;
  load.name = read_name(section, names_of(scene.loads));
  load.body = section.reference("body", "the name of a body", names_of(scene.bodies));
  if (scene.bodies[static_cast<std::size_t>(load.body)].fixed)
    section.fail("body", "a moving body");
  load.moment = section.choice("kind", kinds);
  load.vector = scene.force_to_n * (load.moment ? scene.length_to_mm : 1) *
                section.vector("vector", load.moment ? "a moment" : "a force");
  if (section.has("at")) {
    if (load.moment) section.fail("at", "no point of application: a moment has none");
    load.at = scene.length_to_mm * section.vector("at", "a point in the frame of the body");
  }
  if (section.has("follows")) load.follows_body = section.choice("follows", frames);
  load.scale = section.number_or("scale", 1, "a factor on the vector");
  section.finish();
  return load;
}

// "NAME" of a condition or "NAME.scale" of a load.
void read_varied(const Section& section, const Scene& scene, SweepDescription& sweep) {
  std::vector<std::string> names = names_of(scene.conditions);
  const auto conditions = static_cast<int>(names.size());
  for (const LoadDescription& load : scene.loads) names.push_back(load.name + ".scale");
  const int index =
      section.reference("vary", "the name of a condition, or NAME.scale of a load", names);
  sweep.vary = names[static_cast<std::size_t>(index)];
  if (std::count(names.begin(), names.end(), sweep.vary) > 1)
    section.fail("vary", "another name: a condition and the scale of a load are both called that");
  sweep.varies_load = index >= conditions;
  sweep.index = sweep.varies_load ? index - conditions : index;
}

void read_values(const Section& section, SweepDescription& sweep) {
  if (section.has("values")) {
    for (const char* key : {"from", "to", "step"}) {
      if (section.has(key)) section.fail(key, "either values or from, to and step, not both");
    }
    sweep.values = section.numbers("values", "values [v1, v2, ...]");
    return;
  }
  WrittenRange range;
  range.from = section.number("from", "a number (or values in place of from, to and step)");
  range.to = section.number("to", "a number");
  if (range.from != range.to || section.has("step"))
    range.step = section.number("step", "a number");
  sweep.range = range;
  try {
    sweep.values = range_values(range);
  } catch (const InputError& error) {
    section.fail_with(error.what());
  }
}

}  // namespace

double read_angle(const Section& section, const std::string& key, const Scene& scene) {
  const double angle = scene.angle_to_rad * section.number(key, "an angle");
  if (!is_usable_angle(angle))
    section.fail(key, "an angle of at most one turn (suspect [units] angle)");
  return angle;
}

Eigen::Vector3d read_rotation(const Section& section, const std::string& key, const Scene& scene) {
  Eigen::Vector3d rotation = scene.angle_to_rad * section.vector(key, "a rotation vector");
  if (!is_usable_angle(rotation.norm()))
    section.fail(key, "a rotation vector of at most one turn (suspect [units] angle)");
  return rotation;
}

void read_conditions(const Section& root, Scene& scene) {
  for (const Section& section : root.sections("condition"))
    scene.conditions.push_back(read_condition(section, scene));
}

void read_loads(const Section& root, Scene& scene) {
  for (const Section& section : root.sections("load"))
    scene.loads.push_back(read_load(section, scene));
}

void read_sweep(const Section& root, Scene& scene) {
  if (!root.has("sweep")) return;
  const Section section =
      root.table("sweep", "a table [sweep] with vary and from, to, step or values");
  SweepDescription sweep;
  static const Choices<bool> paths = {{"steps", false}, {"arc length", true}};
  read_varied(section, scene, sweep);
  if (section.has("path")) sweep.arc_length = section.choice("path", paths);
  read_values(section, sweep);
  if (sweep.arc_length && sweep.values.size() < 2)
    section.fail("path",
                 "\"steps\": a path that is followed by its arc length needs two values or more");
  if (section.has("sensitivities"))
    sweep.sensitivities = read_scene_numbers(section, "sensitivities", scene);
  section.finish();
  scene.sweep = sweep;
  const double factor = quantity_of_sweep(scene).declared.factor;
  for (double& value : scene.sweep->values) value *= factor;
  if (const std::string fault = fault_of_values(scene); !fault.empty()) section.fail_with(fault);
}

}  // namespace condyle
