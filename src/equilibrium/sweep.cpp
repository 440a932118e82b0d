#include "equilibrium/sweep.h"

#include <cassert>
#include <cmath>

#include "equilibrium/build_model.h"
#include "equilibrium/equilibrium_solver.h"

namespace condyle {
namespace {

constexpr int kMostSubdivisions = 64;

/// The one number of the model that the sweep drives.
class SweptValue {
 public:
  SweptValue(const SweepDescription& sweep, Model& model) : sweep_(sweep), model_(model) {}
  void set(double value) {
    (sweep_.varies_load ? model_.loads[sweep_.index].scale : model_.conditions[sweep_.index].value) = value;
  }

 private:
  const SweepDescription& sweep_;
  Model& model_;
};

/// Goes from `from`, where an equilibrium is known, to `to` in ever smaller steps.
PoseResult solve_in_steps(EquilibriumSolver& solver, SweptValue& swept, double from, double to) {
  PoseResult result;
  int iterations = 0;
  double seconds = 0;
  const EquilibriumState start = solver.state();
  for (int pieces = 2; pieces <= kMostSubdivisions; pieces *= 2) {
    solver.set_state(start);
    for (int i = 1; i <= pieces; ++i) {
      swept.set(from + (to - from) * i / pieces);
      result = solver.solve();
      iterations += result.iterations;
      seconds += result.seconds;
      if (!result.converged()) break;
    }
    if (result.converged() || result.status == PoseStatus::kLeftPatch) break;
  }
  if (!result.converged()) solver.set_state(start);
  result.iterations = iterations;
  result.seconds = seconds;
  return result;
}

}  // namespace

SweepResult sweep(const Scene& scene, const std::vector<FittedSurface>& surfaces, const SweepOptions& options) {
  assert(scene.sweep);
  EquilibriumOptions equilibrium;
  equilibrium.stability = options.stability;
  EquilibriumSolver solver(build_model(scene, surfaces), equilibrium);
  SweptValue swept(*scene.sweep, solver.model());
  SweepResult result;
  result.poses.reserve(scene.sweep->values.size());
  bool known = false;
  double last = 0;
  for (const double value : scene.sweep->values) {
    swept.set(value);
    PoseResult pose = solver.solve();
    if (!pose.converged() && pose.status != PoseStatus::kLeftPatch && known) {
      PoseResult again = solve_in_steps(solver, swept, last, value);
      again.iterations += pose.iterations;
      again.seconds += pose.seconds;
      pose = std::move(again);
    }
    pose.value = value;
    if (pose.converged()) {
      known = true;
      last = value;
    }
    if (options.on_pose) options.on_pose(pose);
    result.poses.push_back(std::move(pose));
  }
  return result;
}

}  // namespace condyle
