#include "accuracy/part_scenes.h"

#include <cmath>
#include <utility>

#include "benchmark/patch_knee.h"

namespace condyle::accuracy {
namespace {

constexpr double kStep = 5 * M_PI / 180;

Model knee(bool patches) { return patches ? benchmarks::patch_knee() : test::quadric_knee(); }

/// What the ligaments leave to prescribe: with two contacts and the flexion nothing is free.
std::vector<KinematicCondition> in_place_of_ligaments(const Model& model) {
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
  if (!parts.ligaments) {
    model.elements.clear();
    model.element_names.clear();
    for (const KinematicCondition& condition : in_place_of_ligaments(model)) {
      model.conditions.push_back(condition);
      model.condition_names.emplace_back("in place of ligaments");
    }
  }
  if (!parts.joint) model.joint.reset();
  if (!parts.search)
    for (ContactPair& pair : model.pairs) pair.mode = ContactMode::kClosed;
  return model;
}

/// The flexions, and where ligaments are left out what the knee does with them.
std::vector<std::vector<double>> make_values(const Parts& parts) {
  std::vector<std::vector<double>> values;
  EquilibriumSolver solver(knee(parts.patches));
  for (int pose = 0; pose <= PartSweep::kPoses; ++pose) {
    std::vector<double>& here = values.emplace_back(1, pose * kStep);
    if (parts.ligaments) continue;
    solver.model().conditions[0].value = here[0];
    const RigidTransform X = solver.solve().X_BA;
    for (const KinematicCondition& condition : in_place_of_ligaments(solver.model()))
      here.push_back(evaluate(condition, X).coordinate);
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
  static const std::vector<PartScene> all{
      {"all", "patches, ligaments, joint frame, stability, search", {}},
      {"patches", "without patches: exact surfaces", {.patches = false}},
      {"ligaments", "without ligaments: prescribed in their place", {.ligaments = false}},
      {"joint", "without joint frame", {.joint = false}},
      {"stability", "without stability", {.stability = false}},
      {"search", "without search for contacts: held closed", {.search = false}},
      {"none", "without all of these", {false, false, false, false, false}}};
  return all;
}

PartSweep::PartSweep(const Parts& parts)
    : model_(make_model(parts)),
      options_(make_options(parts)),
      values_(make_values(parts)),
      solver_(at_first(model_, values_[0]), options_) {}

PartSweep::PartSweep(const PartSweep& other, Model model)
    : model_(std::move(model)),
      options_(other.options_),
      values_(other.values_),
      solver_(at_first(model_, values_[0]), options_) {}

void PartSweep::solve(int pose, PoseResult& result) {
  const std::vector<double>& values = values_[static_cast<std::size_t>(pose)];
  for (std::size_t i = 0; i < values.size(); ++i) solver_.model().conditions[i].value = values[i];
  solver_.solve(result);
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
