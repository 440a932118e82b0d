/// Scenes of the grammar swept: what is called converged is finite and in balance, what is not has a
/// reason.

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

void use(Choices& choices, const std::string& text) {
  Run run;
  run.scene = parse_scene(text, "made.toml");
  if (!run.scene.sweep) return;
  const bool verified = choices.once_in(4);
  const std::vector<FittedSurface> surfaces = fit_surfaces(run.scene, {}, {}, 1);
  run.sweep = sweep(run.scene, surfaces);
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
