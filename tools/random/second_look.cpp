#include "random/second_look.h"

#include <fmt/format.h>

#include <algorithm>

#include "condyle/equilibrium/build_model.h"
#include "condyle/equilibrium/sweep.h"
#include "condyle/math/rotation.h"
#include "condyle/verify/verify.h"
#include "random/draws.h"

namespace condyle::random_knees {
namespace {

constexpr int kStarts = 6;       ///< a pose
constexpr int kParts = 8;        ///< of a step on the slow way
constexpr double kFar = 4;       ///< of the starts from each other [mm]
constexpr double kTurned = 0.1;  ///< [rad]

/// Is there nothing against a pose of the run's scene?
bool holds(const Run& run, const PoseResult& pose) {
  if (!pose.converged()) return false;
  Run one;
  one.scene = run.scene;
  one.patches = run.patches;
  one.sweep.poses = {pose};
  VerifyOptions options;
  options.meshes = false;
  return verify_run(one, options).verified();
}

struct Again {
  const Run& run;
  Model model;
  Swept swept;

  PoseResult solve_from(const RigidTransform& X, double value) {
    model.start = X;
    EquilibriumSolver solver(model);
    return solver.solve(swept.with(drive_of(model), value));
  }

  /// In small steps from a pose that converged.
  PoseResult go_slowly(const PoseResult& from, double value) {
    model.start = model.origins.into_model(from.X_BA);
    EquilibriumSolver solver(model);
    PoseResult pose;
    for (int i = 0; i <= kParts; ++i)
      solver.solve(swept.with(drive_of(model), from.value + (value - from.value) * i / kParts),
                   pose);
    return pose;
  }
};

}  // namespace

void look_again(const Run& run, const std::vector<FittedSurface>& surfaces, SweepOutcome& outcome) {
  const std::vector<PoseResult>& poses = run.sweep.poses;
  if (std::all_of(poses.begin(), poses.end(), [](const PoseResult& p) { return p.converged(); }))
    return;
  Again again{run, build_model(run.scene, surfaces), swept_of(*run.scene.sweep)};
  const RigidTransform start = again.model.start;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (poses[i].converged()) continue;
    outcome.poses[i].looked_again = true;
    Draws draws(0, i);
    const auto found = [&](const PoseResult& pose, const char* way) {
      if (!holds(run, pose)) return false;
      outcome.poses[i].found = true;
      outcome.faults.push_back(fmt::format("missed: pose {} ({}: {}) is found {}", i,
                                           name(poses[i].status), poses[i].reason, way));
      return true;
    };
    bool done = false;
    for (std::size_t j = 0; j < poses.size() && !done; ++j)
      if (poses[j].converged() && (j + 1 == i || j == i + 1))
        done = found(again.go_slowly(poses[j], poses[i].value), "in smaller steps");
    for (int k = 0; k < kStarts && !done; ++k) {
      RigidTransform X = start;
      X.p += draws.within(kFar);
      X.R = exp_rotation(draws.within(kTurned)) * X.R;
      done = found(again.solve_from(X, poses[i].value), "from another start");
    }
  }
}

}  // namespace condyle::random_knees
