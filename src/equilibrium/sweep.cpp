#include "equilibrium/sweep.h"

#include <cassert>
#include <optional>
#include <utility>

#include "equilibrium/build_model.h"
#include "equilibrium/equilibrium_solver.h"
#include "equilibrium/events.h"

namespace condyle {
namespace {

/// The one number of the model that the sweep drives.
double& swept_value(const SweepDescription& sweep, Model& model) {
  const auto index = static_cast<std::size_t>(sweep.index);
  return sweep.varies_load ? model.loads[index].scale : model.conditions[index].value;
}

}  // namespace

SweepResult sweep(const Scene& scene,
                  const std::vector<FittedSurface>& surfaces,
                  const SweepOptions& options) {
  assert(scene.sweep);
  EquilibriumOptions equilibrium;
  equilibrium.description.stability = options.stability;
  EquilibriumSolver solver(build_model(scene, surfaces), equilibrium);
  double& swept = swept_value(*scene.sweep, solver.model());
  SweepResult result;
  result.poses.reserve(scene.sweep->values.size());
  std::optional<SolvedPose> last;
  for (const double value : scene.sweep->values) {
    swept = value;
    PoseResult pose = solver.solve();
    pose.value = value;
    if (options.on_pose) options.on_pose(pose);
    if (options.events && is_solved(pose)) {
      const SolvedPose now{value, pose, solver.state()};
      if (last) locate_events(solver, swept, *last, now, result.events);
      swept = value;
      solver.set_state(now.state);
      last = now;
    }
    result.poses.push_back(std::move(pose));
  }
  return result;
}

}  // namespace condyle
