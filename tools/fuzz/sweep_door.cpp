/// Scenes of the grammar swept: what is called converged is finite and in balance, what is not has a
/// reason. The same ways as in the program, given up after an eighth of its work: most made scenes have no equilibrium, and
/// what takes a search to its end is what it has begun with.

#include <cmath>
#include <stdexcept>

#include "condyle/equilibrium/build_model.h"
#include "condyle/equilibrium/sweep.h"
#include "condyle/results/sweep_table.h"
#include "condyle/scene/swept_quantity.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/specimen/fit_surfaces.h"
#include "condyle/verify/verify.h"
#include "fuzz/door_list.h"
#include "fuzz/refusal.h"
#include "fuzz/scene_grammar.h"

namespace condyle::fuzz {
namespace {

void expect_sound(const PoseResult& pose) {
  if (!pose.solved()) {
    if (pose.status != PoseStatus::kConverged) expect_one_line(pose.reason);
    return;
  }
  bool finite = pose.X_BA.R.allFinite() && pose.X_BA.p.allFinite() && std::isfinite(pose.residual);
  for (const LigamentResult& ligament : pose.ligaments)
    finite = finite && std::isfinite(ligament.length) && std::isfinite(ligament.force);
  for (const ContactResult& contact : pose.contacts)
    finite = finite && std::isfinite(contact.force);
  for (const ConditionResult& condition : pose.conditions)
    finite = finite && std::isfinite(condition.value) && std::isfinite(condition.multiplier);
  if (!finite) throw std::logic_error("a solved pose is not finite");
}

constexpr long kLess = 8;  // times

SweepResult sweep_briefly(const Scene& scene) {
  EquilibriumOptions options = equilibrium_options(scene);
  options.most.points /= kLess;
  options.most_at_first.points /= kLess;
  EquilibriumSolver solver(build_model(scene, fit_surfaces(scene, {}, {}, 1)), options);
  return sweep(solver, *scene.sweep);
}

void use(Choices& choices, const std::string& text) {
  Run run;
  run.scene = parse_scene(text, "made.toml");
  if (!run.scene.sweep) return;
  const bool verified = choices.once_in(4);
  run.sweep = sweep_briefly(run.scene);
  const SweptQuantity swept = quantity_of_sweep(run.scene);
  for (const PoseResult& pose : run.sweep.poses) expect_sound(pose);
  for (const std::string& line : failures(swept, run.sweep)) expect_one_line(line);
  if (!verified) return;
  const Verification verification = verify_run(run);
  if (!verification.verified())
    throw std::logic_error("a false pose: " + verification.faults.front().text);
}

}  // namespace

void open_sweep(Bytes bytes) {
  Choices choices(bytes);
  const std::string text = made_scene(choices, Temper::kTame);
  taken([&] { use(choices, text); });
}

}  // namespace condyle::fuzz
