#include "condyle/verify/verify.h"

#include <fmt/format.h>

#include <chrono>
#include <optional>

#include "condyle/input_error.h"
#include "condyle/results/run_view.h"
#include "condyle/results/without_poses.h"
#include "condyle/verify/column_checks.h"
#include "condyle/verify/gap_checks.h"
#include "condyle/verify/layer_checks.h"
#include "condyle/verify/ledger.h"
#include "condyle/verify/mesh_checks.h"
#include "condyle/verify/pose_checks.h"
#include "condyle/verify/push_check.h"

namespace condyle {
namespace {

using namespace verification;

void check_kind(const Run& run, std::vector<std::string>& not_checked) {
  if (run.sweep.poses.empty())
    throw InputError(no_poses(run) + ", expected a run of sweep, compare or simulate");
  const Scene& scene = run.scene;
  for (const ContactDescription& contact : scene.contacts)
    for (const int surface : contact.surfaces)
      if (surface < 0 || static_cast<std::size_t>(surface) >= scene.surfaces.size())
        throw InputError(
            fmt::format("contact \"{}\" has no surfaces, expected two of the scene", contact.name));
  for (const PoseResult& pose : run.sweep.poses)
    if (pose.converged() && (pose.contacts.size() != scene.contacts.size() ||
                             pose.ligaments.size() != scene.ligaments.size() ||
                             pose.conditions.size() != scene.conditions.size()))
      throw InputError("a pose has not one result for each element of the scene");
  if (run.kind() == RunKind::kSimulation)
    not_checked.emplace_back("a motion is no series of equilibria: forces do not have to balance");
  if (run.kind() == RunKind::kComparison)
    not_checked.emplace_back("the poses of the reference model");
}

void check_pose(const Subject& subject,
                const PoseResult& pose,
                const GapCheck& gaps,
                const MeshCheck* meshes,
                const PushCheck* pushes,
                Ledger& ledger) {
  if (!check_motion(subject, pose, ledger)) return;
  check_ligaments(subject, pose, ledger);
  check_conditions(subject, pose, ledger);
  check_contacts(subject, pose, ledger);
  if (!subject.moving()) check_balance(subject, pose, ledger);
  gaps.check(pose, ledger);
  check_layers(subject, pose, ledger);
  if (meshes != nullptr) meshes->check(pose, ledger);
  if (pushes != nullptr) pushes->check(pose, ledger);
}

}  // namespace

Verification verify_run(const Run& run, const VerifyOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  Verification result;
  check_kind(run, result.not_checked);
  const std::vector<std::unique_ptr<SurfaceSide>> sides = make_sides(run);
  const Subject subject{run, sides, swept_quantity(run)};
  const GapCheck gaps(subject, result.not_checked);
  std::optional<MeshCheck> meshes;
  if (options.meshes) meshes.emplace(run, result.not_checked);
  std::optional<PushCheck> pushes;
  if (options.pushes && !subject.moving()) pushes.emplace(subject);
  Ledger ledger(subject.swept);
  check_slack_lengths(run, ledger, result.not_checked);
  if (options.columns != nullptr) check_columns(*options.columns, run, ledger);
  const std::vector<PoseResult>& poses = run.sweep.poses;
  result.poses = poses.size();
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (poses[i].converged()) {
      ++result.converged;
      ledger.at_pose(i, poses[i].value);
      check_pose(subject, poses[i], gaps, meshes ? &*meshes : nullptr, pushes ? &*pushes : nullptr,
                 ledger);
    }
    if (options.on_pose) options.on_pose(static_cast<int>(i) + 1, static_cast<int>(poses.size()));
  }
  ledger.close(result);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

std::string verdict(const Verification& v) {
  const std::string converged = fmt::format("{} of {} poses converged", v.converged, v.poses);
  if (v.converged == 0) return converged + ": nothing to verify";
  if (v.verified()) return converged + ", none of them is false";
  return fmt::format("{}, {} of them {} false", converged, v.false_poses,
                     v.false_poses == 1 ? "is" : "are");
}

std::vector<std::string> check_lines(const Verification& verification) {
  std::vector<std::string> lines;
  lines.push_back(fmt::format("{:<32} {:>9} {:>9} {:<9} {:>6}  {}", "check", "worst", "allowed", "",
                              "wrong", "where"));
  for (const CheckSummary& check : verification.checks) {
    if (check.count == 0) continue;
    lines.push_back(fmt::format("{:<32} {:>9.2g} {:>9.2g} {:<9} {:>6}  {}", check.name,
                                check.figure, check.allowed, check.units == "1" ? "" : check.units,
                                check.failed, check.where));
  }
  return lines;
}

}  // namespace condyle
