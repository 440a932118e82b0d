#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <regex>
#include <sstream>
#include <stdexcept>

#include "condyle/equilibrium/build_model.h"
#include "condyle/equilibrium/path_system.h"
#include "condyle/equilibrium/restore_state.h"
#include "condyle/equilibrium/sweep.h"
#include "condyle/math/decompositions.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/specimen/fit_surfaces.h"
#include "support/hard_cases.h"

namespace condyle::hard {
namespace {

std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream) throw std::runtime_error("cannot read " + file.string());
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

char letter(PoseStatus status) {
  switch (status) {
    case PoseStatus::kConverged:
      return 'c';
    case PoseStatus::kLeftPatch:
      return 'l';
    case PoseStatus::kNoEquilibrium:
      return 'n';
    case PoseStatus::kSingular:
      return 's';
    case PoseStatus::kZeroLength:
      return 'z';
    case PoseStatus::kNoPath:
      return 'p';
    case PoseStatus::kOverlap:
      return 'o';
    case PoseStatus::kIterationLimit:
      return 'i';
    case PoseStatus::kDiverged:
      return 'd';
    case PoseStatus::kNotComputed:
      break;
  }
  return '?';
}

double condition_number(const Model& model, const EquilibriumState& state, const Drive& drive) {
  NewtonSystem system(model);
  if (!system.assemble(state, drive)) return std::numeric_limits<double>::infinity();
  SmallLu matrix;
  double right_side[SmallLu::kMaxSize];
  const int size = system.fill(state, matrix, right_side);
  Eigen::MatrixXd dense(size, size);
  for (int i = 0; i < size; ++i)
    for (int j = 0; j < size; ++j) dense(i, j) = matrix(i, j);
  const Eigen::VectorXd values = singular_values(dense).values;
  return values[0] / values[size - 1];
}

bool is_finite(const PoseResult& pose) {
  bool finite = pose.X_BA.p.allFinite() && pose.X_BA.R.allFinite() && std::isfinite(pose.residual);
  for (const ContactResult& contact : pose.contacts) finite &= std::isfinite(contact.force);
  for (const LigamentResult& ligament : pose.ligaments)
    finite &= std::isfinite(ligament.length) && std::isfinite(ligament.force);
  for (const ConditionResult& condition : pose.conditions)
    finite &= std::isfinite(condition.value) && std::isfinite(condition.multiplier);
  return finite;
}

/// The largest of the poses that converged; of the solver's own state where none did.
double largest_condition(EquilibriumSolver& solver, const Swept& swept, const SweepResult& sweep) {
  Drive drive = drive_of(solver.model());
  double largest = 0;
  for (const PoseResult& pose : sweep.poses) {
    if (!pose.converged() || !can_restore(solver.model(), pose)) continue;
    swept.in(drive) = pose.value;
    largest = std::max(
        largest, condition_number(solver.model(), restore_state(solver.model(), pose), drive));
  }
  return largest > 0 ? largest : condition_number(solver.model(), solver.state(), drive);
}

/// How far the last pose is from where as many equal steps lead: |Δa|/L or the angle.
double far_from_steps(const Model& model, const Swept& swept, const SweepResult& sweep, int steps) {
  EquilibriumSolver solver(model);
  PoseResult pose;
  for (int k = 0; k <= steps; ++k) {
    const double from = sweep.poses.front().value, to = sweep.poses.back().value;
    solver.solve(swept.with(drive_of(model), from + (to - from) * k / steps), pose);
    if (!pose.converged()) return std::numeric_limits<double>::infinity();
  }
  const PoseResult& last = sweep.poses.back();
  return std::max((last.X_BA.p - pose.X_BA.p).norm() / model.length,
                  (last.X_BA.R - pose.X_BA.R).norm());
}

void solve(const Scene& scene, const HardCase& hard, HardOutcome& outcome) {
  const std::vector<FittedSurface> surfaces = fit_surfaces(scene);
  const Model model = build_model(scene, surfaces);
  EquilibriumSolver solver(model);
  const Swept swept = swept_of(*scene.sweep);
  outcome.sweep =
      scene.sweep->arc_length ? sweep(scene, surfaces) : sweep(solver, swept, scene.sweep->values);
  outcome.condition = largest_condition(solver, swept, outcome.sweep);
  if (hard.error) outcome.error = hard.error(outcome.sweep);
  if (hard.steps > 0) outcome.error = far_from_steps(model, swept, outcome.sweep, hard.steps);
}

}  // namespace

bool HardOutcome::as_expected(const HardCase& hard) const {
  return std::regex_match(statuses, std::regex(hard.expected));
}

HardOutcome run(const HardCase& hard, const std::filesystem::path& root) {
  const std::filesystem::path file = root / "data/hard" / hard.file;
  std::string text = text_of(file);
  for (const auto& [from, to] : hard.changes) {
    const std::size_t at = text.find(from);
    if (at == std::string::npos) throw std::runtime_error(file.string() + " has no " + from);
    text.replace(at, from.size(), to);
  }
  HardOutcome outcome;
  solve(parse_scene(text, file), hard, outcome);
  outcome.has_words = hard.words.empty();
  for (const PoseResult& pose : outcome.sweep.poses) {
    outcome.statuses += letter(pose.status);
    outcome.iterations = std::max(outcome.iterations, pose.iterations);
    outcome.has_words |= pose.reason.find(hard.words) != std::string::npos ||
                         pose.remark.find(hard.words) != std::string::npos;
    if (!pose.converged()) continue;
    outcome.residual = std::max(outcome.residual, pose.residual);
    outcome.finite &= is_finite(pose);
  }
  return outcome;
}

}  // namespace condyle::hard
