#include "random/sweep_outcome.h"

#include <time.h>

#include <exception>

#include "condyle/equilibrium/build_model.h"
#include "condyle/equilibrium/sweep.h"
#include "condyle/input_error.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/specimen/check_layers.h"
#include "condyle/specimen/fit_surfaces.h"
#include "condyle/verify/verify.h"
#include "random/second_look.h"

namespace condyle::random_knees {
namespace {

/// Processor time of each pose: what passed until it was told, of poses that are told together, as a gap
/// and the pose after it, in the proportion of what they say themselves.
struct PoseClock {
  double told = thread_seconds();  ///< when the last pose was told
  std::vector<double> passed;      ///< until each was told

  void tell() {
    const double now = thread_seconds();
    passed.push_back(now - told);
    told = now;
  }
  void share_out(const std::vector<PoseResult>& poses, std::vector<PoseOutcome>& outcomes) const {
    const bool each = passed.size() == poses.size();
    for (std::size_t begin = 0, end = 0; begin < poses.size(); begin = end) {
      double all = 0, said = 1e-12;
      for (bool more = true; more && end < poses.size(); ++end) {
        all += each ? passed[end] : 0;
        said += poses[end].seconds + poses[end].event_seconds;
        more = !each || !poses[end].converged();
      }
      if (!each) all = thread_seconds() - told;
      for (std::size_t i = begin; i < end; ++i)
        outcomes[i].seconds = all * (poses[i].seconds + poses[i].event_seconds) / said;
    }
  }
};

void sweep_knee(Run& run, const std::vector<FittedSurface>& surfaces, SweepOutcome& outcome) {
  const double begin = thread_seconds();
  SweepOptions options;
  EquilibriumSolver solver(build_model(run.scene, surfaces),
                           equilibrium_options(run.scene, options));
  outcome.set_up_seconds = thread_seconds() - begin;
  PoseClock clock;
  options.on_computed = [&](const KnownPose&) { clock.tell(); };
  run.sweep = sweep(solver, *run.scene.sweep, options);
  for (const PoseResult& pose : run.sweep.poses) outcome.poses.push_back({pose.status});
  clock.share_out(run.sweep.poses, outcome.poses);
  outcome.seconds = thread_seconds() - begin;
}

void judge(const Run& run, const LookOptions& options, SweepOutcome& outcome) {
  if (run.sweep.poses.empty()) return;
  VerifyOptions verify;
  verify.meshes = false;
  verify.pushes = options.pushes;
  const Verification verification = verify_run(run, verify);
  for (const Fault& fault : verification.faults) {
    outcome.poses[fault.pose].is_false = true;
    outcome.faults.push_back("false: " + fault.text);
  }
}

}  // namespace

double thread_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

Run run_of(const RandomKnee& knee) {
  Run run;
  run.scene = parse_scene(knee.text, knee.scene.file);
  for (std::size_t i = 0; i < knee.patches.size(); ++i)
    if (knee.patches[i])
      run.patches.push_back(
          {run.scene.surfaces[i].name, run.scene.surfaces[i].body, *knee.patches[i], {}});
  return run;
}

std::vector<FittedSurface> surfaces_of(const RandomKnee& knee, const Scene& scene) {
  std::vector<FittedSurface> surfaces(scene.surfaces.size());
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    if (!knee.patches[i]) {
      surfaces[i].surface = make_exact_surface(scene.surfaces[i]);
      continue;
    }
    surfaces[i].surface = std::make_shared<Patch>(*knee.patches[i]);
    surfaces[i].report.emplace().surface = scene.surfaces[i].name;
  }
  check_layers(scene, surfaces);
  return surfaces;
}

SweepOutcome sweep_and_judge(const RandomKnee& knee, const LookOptions& options) {
  SweepOutcome outcome;
  outcome.kind = kind_of(knee);
  const double begin = thread_seconds();
  try {
    Run run = run_of(knee);
    const std::vector<FittedSurface> surfaces = surfaces_of(knee, run.scene);
    sweep_knee(run, surfaces, outcome);
    judge(run, options, outcome);
    if (options.second_look) look_again(run, surfaces, outcome);
  } catch (const InputError& error) {
    outcome.refused = error.what();
  } catch (const std::exception& error) {
    outcome.exception = error.what();
  }
  outcome.checked_seconds = thread_seconds() - begin;
  return outcome;
}

}  // namespace condyle::random_knees
