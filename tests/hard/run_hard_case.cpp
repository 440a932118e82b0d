#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "equilibrium/build_model.h"
#include "equilibrium/path_system.h"
#include "equilibrium/sweep.h"
#include "hard/hard_cases.h"
#include "scene/read_scene.h"

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

double condition_number(const Model& model, const EquilibriumState& state) {
  NewtonSystem system(model);
  if (!system.assemble(state)) return std::numeric_limits<double>::infinity();
  SmallLu matrix;
  double right_side[SmallLu::kMaxSize];
  const int size = system.fill(state, matrix, right_side);
  Eigen::MatrixXd dense(size, size);
  for (int i = 0; i < size; ++i)
    for (int j = 0; j < size; ++j) dense(i, j) = matrix(i, j);
  const Eigen::VectorXd values = dense.jacobiSvd().singularValues();
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

}  // namespace

HardOutcome run(const HardCase& hard, const std::filesystem::path& root) {
  const std::filesystem::path file = root / "data/hard" / hard.file;
  std::string text = text_of(file);
  for (const auto& [from, to] : hard.changes) {
    const std::size_t at = text.find(from);
    if (at == std::string::npos) throw std::runtime_error(file.string() + " has no " + from);
    text.replace(at, from.size(), to);
  }
  const Scene scene = parse_scene(text, file);
  const std::vector<FittedSurface> surfaces = fit_surfaces(scene);
  HardOutcome outcome;
  if (scene.sweep->arc_length) {
    outcome.sweep = sweep(scene, surfaces);
  } else {
    EquilibriumSolver solver(build_model(scene, surfaces));
    const SweptValue swept{scene.sweep->varies_load, static_cast<std::size_t>(scene.sweep->index)};
    outcome.sweep = sweep(solver, swept.in(solver.model()), scene.sweep->values);
    outcome.condition = condition_number(solver.model(), solver.state());
  }
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
  if (hard.error) outcome.error = hard.error(outcome.sweep);
  return outcome;
}

}  // namespace condyle::hard
