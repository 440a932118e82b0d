#include "support/part_scenes.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "support/patch_knee.h"

namespace condyle::accuracy {
namespace {

constexpr double kStep = 5 * M_PI / 180;

Model knee(bool patches) { return patches ? benchmarks::patch_knee() : test::quadric_knee(); }

/// With two contacts and the flexion they leave nothing free.
std::vector<KinematicCondition> more_motions(const Model& model) {
  std::vector<KinematicCondition> conditions;
  for (const ConditionKind kind : {ConditionKind::kInternalRotation, ConditionKind::kLateralShift,
                                   ConditionKind::kAnteriorDrawer}) {
    KinematicCondition condition = model.conditions[0];
    condition.kind = kind;
    conditions.push_back(condition);
  }
  return conditions;
}

Model make_model(const Parts& parts) {
  Model model = knee(parts.patches);
  if (parts.prescribed)
    for (const KinematicCondition& condition : more_motions(model)) {
      model.conditions.push_back(condition);
      model.condition_names.emplace_back("prescribed");
    }
  if (!parts.ligaments) {
    model.elements.clear();
    model.element_names.clear();
  }
  if (!parts.joint) model.joint.reset();
  if (!parts.search)
    for (ContactPair& pair : model.pairs) pair.mode = ContactMode::kClosed;
  return model;
}

/// The flexions, and what the knee with its ligaments does.
std::vector<std::vector<double>> make_values(const Parts& parts) {
  std::vector<std::vector<double>> values;
  EquilibriumSolver solver(knee(parts.patches));
  for (int pose = 0; pose <= PartSweep::kPoses; ++pose) {
    std::vector<double>& here = values.emplace_back(1, pose * kStep);
    if (!parts.prescribed) continue;
    const Drive drive = condition_value(0).with(drive_of(solver.model()), here[0]);
    const RigidTransform X = solver.solve(drive).X_BA;
    for (const KinematicCondition& condition : more_motions(solver.model()))
      here.push_back(evaluate(condition, 0, X).coordinate);
  }
  return values;
}

EquilibriumOptions make_options(const Parts& parts) {
  EquilibriumOptions options;
  options.description.stability = parts.stability;
  return options;
}

Model at_first(Model model, const std::vector<double>& values) {
  for (std::size_t i = 0; i < values.size(); ++i) model.conditions[i].value = values[i];
  return model;
}

}  // namespace

const std::vector<PartScene>& part_scenes() {
  const Parts none{.patches = false,
                   .ligaments = false,
                   .joint = false,
                   .stability = false,
                   .search = false,
                   .prescribed = true};
  static const std::vector<PartScene> all{
      {"all", "patches, ligaments, joint frame, stability, search", {}},
      {"patches", "without patches: exact surfaces", {.patches = false}, "all"},
      {"joint", "without joint frame", {.joint = false}, "all"},
      {"stability", "without stability", {.stability = false}, "all"},
      {"search", "contacts held closed", {.search = false}, "all"},
      {"prescribed", "with three more motions prescribed", {.prescribed = true}},
      {"ligaments",
       "with these, without ligaments",
       {.ligaments = false, .prescribed = true},
       "prescribed"},
      {"none", "with these, without all the rest", none, "ligaments"}};
  return all;
}

const PartScene& part_scene(const std::string& name) {
  for (const PartScene& scene : part_scenes())
    if (scene.name == name) return scene;
  throw std::invalid_argument("no scene " + name);
}

PartSweep::PartSweep(const Parts& parts)
    : model_(make_model(parts)),
      options_(make_options(parts)),
      values_(make_values(parts)),
      solver_(at_first(model_, values_[0]), options_),
      drive_(drive_of(solver_.model())) {}

PartSweep::PartSweep(const PartSweep& other, Model model)
    : model_(std::move(model)),
      options_(other.options_),
      values_(other.values_),
      solver_(at_first(model_, values_[0]), options_),
      drive_(drive_of(solver_.model())) {}

void PartSweep::solve(int pose, PoseResult& result) {
  const std::vector<double>& values = values_[static_cast<std::size_t>(pose)];
  std::copy(values.begin(), values.end(), drive_.values.begin());
  solver_.solve(drive_, result);
}

int PartSweep::there_and_back(PoseResult& result) {
  int converged = 0;
  for (int pose = 1; pose <= kPoses; ++pose) {
    solve(pose, result);
    converged += result.converged() ? 1 : 0;
  }
  for (int pose = kPoses - 1; pose >= 0; --pose) {
    solve(pose, result);
    converged += result.converged() ? 1 : 0;
  }
  return converged;
}

}  // namespace condyle::accuracy
