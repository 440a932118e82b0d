#include "random/sweep_outcome.h"

#include <time.h>

#include <algorithm>
#include <exception>

#include "condyle/equilibrium/sweep.h"
#include "condyle/input_error.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/specimen/check_layers.h"
#include "condyle/specimen/fit_surfaces.h"
#include "condyle/verify/verify.h"
#include "random/second_look.h"

namespace condyle::random_knees {
namespace {

/// What another process takes from the sweep's thread is in no pose's own time: a slow sweep is timed
/// again.
constexpr double kSlow = 0.01;  ///< [s]
constexpr int kRepeats = 1;

void set_times(const SweepResult& sweep, SweepOutcome& outcome) {
  for (std::size_t i = 0; i < outcome.poses.size(); ++i) {
    const PoseResult& pose = sweep.poses[i];
    double& seconds = outcome.poses[i].seconds;
    seconds = std::min(seconds, pose.seconds + pose.event_seconds);
  }
}

void sweep_knee(Run& run, const std::vector<FittedSurface>& surfaces, SweepOutcome& outcome) {
  const double begin = thread_seconds();
  run.sweep = sweep(run.scene, surfaces);
  outcome.seconds = thread_seconds() - begin;
  for (const PoseResult& pose : run.sweep.poses)
    outcome.poses.push_back({pose.status, 1e300, false, false, false});
  set_times(run.sweep, outcome);
  for (int i = 0; i < kRepeats; ++i)
    if (std::any_of(outcome.poses.begin(), outcome.poses.end(),
                    [](const PoseOutcome& pose) { return pose.seconds > kSlow; }))
      set_times(sweep(run.scene, surfaces), outcome);
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
