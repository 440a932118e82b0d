#include "condyle/results/sensitivity_effects.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "condyle/elements/joint_table.h"
#include "condyle/equilibrium/sweep_sensitivities.h"
#include "condyle/results/run_view.h"
#include "condyle/scene/ligament_number.h"

namespace condyle {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;
constexpr double kStrain = 0.01, kPart = 0.1, kLength = 1;  // [-], [-], [mm]

TypicalChange change_of_ligament(const Scene& scene, const SceneParameter& p) {
  const LigamentDescription& ligament = scene.ligaments[static_cast<std::size_t>(p.number.index)];
  switch (p.number.kind) {
    case ParameterKind::kReferenceStrain:
      return {kStrain, "+0.01", "0.01 more reference strain of " + ligament.name};
    case ParameterKind::kTransitionStrain:
      return {kStrain, "+0.01", "0.01 more transition strain of " + ligament.name};
    case ParameterKind::kStiffness:
      return {kPart * number_of(scene, ligament, ParameterKind::kStiffness), "+10 %",
              "10 % more stiffness of " + ligament.name};
    default:
      return {kLength, "+1 mm", "1 mm more slack length of " + ligament.name};
  }
}

TypicalChange change_of_load(const Scene& scene, const SceneParameter& p) {
  const LoadDescription& load = scene.loads[static_cast<std::size_t>(p.number.index)];
  const char axis = "xyz"[p.component];
  if (p.number.kind == ParameterKind::kLoadScale)
    return {kPart, "+0.1", "0.1 more scale of " + load.name};
  if (p.number.kind == ParameterKind::kLoadPoint)
    return {kLength, "+1 mm", fmt::format("the point of {} 1 mm along {}", load.name, axis)};
  const double size = kPart * load.vector.norm();
  const std::string amount = fmt::format("{:.3g} {}", size, load.moment ? "N mm" : "N");
  return {size, "+" + amount, fmt::format("{} more of {} along {}", amount, load.name, axis)};
}

TypicalChange change_of_condition(const Scene& scene, const SceneParameter& p) {
  const ConditionDescription& condition =
      scene.conditions[static_cast<std::size_t>(p.number.index)];
  if (is_angle(condition.kind)) return {1 / kDegrees, "+1°", "1° more of " + condition.name};
  return {kLength, "+1 mm", "1 mm more of " + condition.name};
}

struct Directions {
  const char *more, *less;
};
/// What the tibia does where a joint coordinate rises or falls, in their order.
constexpr std::array<Directions, 6> kDirections = {{{"into flexion", "into extension"},
                                                    {"into adduction", "into abduction"},
                                                    {"inwards", "outwards"},
                                                    {"laterally", "medially"},
                                                    {"forwards", "back"},
                                                    {"away from the femur", "towards the femur"}}};

EffectOutput effect_output(const Scene& scene, const SensitivityOutput& output, std::size_t index) {
  const std::size_t of = output.output.index;
  EffectOutput shown{index, EffectGroup::kForce, {}, "more", "less", 1};
  switch (output.output.kind) {
    case OutputKind::kJointCoordinate: {
      const JointCoordinate& q = kJointCoordinates[of];
      shown.group = q.angle ? EffectGroup::kRotation : EffectGroup::kTranslation;
      shown.name = q.words;
      shown.more = kDirections[of].more;
      shown.less = kDirections[of].less;
      if (q.angle) shown.per_inside = kDegrees;
      break;
    }
    case OutputKind::kContactForce:
      shown.name = scene.contacts[of].name;
      break;
    case OutputKind::kLigamentForce:
      shown.name = scene.ligaments[of].name;
      break;
    default:
      shown.name = scene.conditions[of].name;
      if (!is_angle(scene.conditions[of].kind)) break;
      shown.group = EffectGroup::kMoment;
      shown.per_inside = 1e-3;
  }
  return shown;
}

bool has_derivatives(const Run& run, std::size_t pose) {
  const Eigen::MatrixXd& J = run.sensitivities->by_pose[pose];
  return J.size() > 0 && J.allFinite();
}

/// Of the poses in `usable` the nearest to each usual angle, where it is near.
std::vector<std::size_t> at_usual_angles(const Run& run, const std::vector<std::size_t>& usable) {
  constexpr double kNear = 5.1;  // [deg]
  std::vector<std::size_t> found;
  for (const double angle : {0.0, 30.0, 60.0, 90.0}) {
    const auto off = [&](std::size_t pose) {
      return std::abs(kDegrees * run.sweep.poses[pose].value - angle);
    };
    const auto nearest =
        std::min_element(usable.begin(), usable.end(),
                         [&](std::size_t a, std::size_t b) { return off(a) < off(b); });
    if (nearest == usable.end() || off(*nearest) > kNear) continue;
    if (std::find(found.begin(), found.end(), *nearest) == found.end()) found.push_back(*nearest);
  }
  return found;
}

}  // namespace

TypicalChange typical_change(const Scene& scene, const SceneParameter& p) {
  const char axis = "xyz"[p.component];
  const auto index = static_cast<std::size_t>(p.number.index);
  switch (p.number.kind) {
    case ParameterKind::kInsertion:
      return {kLength, "+1 mm",
              fmt::format("{} insertion on the {} 1 mm along {}", scene.ligaments[index].name,
                          scene.bodies[static_cast<std::size_t>(p.number.body)].name, axis)};
    case ParameterKind::kSurfaceShift:
      return {kLength, "+1 mm", fmt::format("{} 1 mm along {}", scene.surfaces[index].name, axis)};
    case ParameterKind::kLayerModulus:
      return {kPart, "+10 %", "10 % more modulus of " + scene.surfaces[index].name};
    case ParameterKind::kConditionValue:
      return change_of_condition(scene, p);
    case ParameterKind::kLoadScale:
    case ParameterKind::kLoadVector:
    case ParameterKind::kLoadPoint:
      return change_of_load(scene, p);
    default:
      return change_of_ligament(scene, p);
  }
}

const char* unit_of(EffectGroup group) {
  constexpr std::array<const char*, kEffectGroups> kUnits = {"°", "mm", "N", "N m"};
  return kUnits[static_cast<std::size_t>(group)];
}

std::vector<EffectOutput> effect_outputs(const Run& run) {
  std::vector<EffectOutput> outputs;
  for (std::size_t i = 0; i < run.sensitivities->outputs.size(); ++i)
    outputs.push_back(effect_output(run.scene, run.sensitivities->outputs[i], i));
  return outputs;
}

double effect(const Run& run,
              std::size_t pose,
              const EffectOutput& output,
              std::size_t j,
              const TypicalChange& change) {
  return output.per_inside * change.inside *
         run.sensitivities->by_pose[pose](static_cast<Eigen::Index>(output.index),
                                          static_cast<Eigen::Index>(j));
}

std::vector<std::size_t> shown_sensitivities(const Run& run) {
  constexpr std::size_t kMost = 4;
  std::vector<std::size_t> usable;
  for (std::size_t pose = 0; pose < run.sensitivities->by_pose.size(); ++pose)
    if (has_derivatives(run, pose)) usable.push_back(pose);
  if (swept_quantity(run).flexion) {
    std::vector<std::size_t> usual = at_usual_angles(run, usable);
    if (usual.size() >= 2) return usual;
  }
  const std::size_t n = std::min(kMost, usable.size());
  std::vector<std::size_t> shown;
  for (std::size_t k = 0; k < n; ++k)
    shown.push_back(usable[n == 1 ? 0 : k * (usable.size() - 1) / (n - 1)]);
  return shown;
}

}  // namespace condyle
