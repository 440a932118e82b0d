#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>

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
  HardOutcome outcome;
  outcome.sweep = sweep(scene, fit_surfaces(scene));
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
