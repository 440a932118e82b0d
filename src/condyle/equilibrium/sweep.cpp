#include "condyle/equilibrium/sweep.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "condyle/equilibrium/arc_length.h"
#include "condyle/equilibrium/build_model.h"
#include "condyle/equilibrium/sweep_walk.h"

namespace condyle {
namespace {

/// The greatest distance of two neighbouring values: what an arc-length sweep does not exceed.
double largest_step(const std::vector<double>& values) {
  double largest = 0;
  for (std::size_t i = 1; i < values.size(); ++i)
    largest = std::max(largest, std::abs(values[i] - values[i - 1]));
  return largest;
}

}  // namespace

SweepResult sweep(EquilibriumSolver& solver,
                  const Swept& swept,
                  const std::vector<double>& values,
                  const SweepOptions& options) {
  return SweepWalk(solver, swept, options).along(values);
}

SweepResult sweep(EquilibriumSolver& solver,
                  const SweepDescription& description,
                  const SweepOptions& options) {
  const Swept swept = swept_of(description);
  const std::vector<double>& values = description.values;
  if (!description.arc_length || values.size() < 2) return sweep(solver, swept, values, options);
  PathOptions path;
  path.on_pose = options.on_pose;
  path.most_poses = std::max(path.most_poses, 4 * static_cast<int>(values.size()));
  return follow_path(solver, swept, values.front(), values.back(), largest_step(values), path);
}

EquilibriumOptions equilibrium_options(const Scene& scene, const SweepOptions& options) {
  EquilibriumOptions equilibrium;
  equilibrium.description.stability = options.stability;
  equilibrium.description.joint_stiffness = options.stability && scene.joint;
  return equilibrium;
}

SweepResult sweep(const Scene& scene,
                  const std::vector<FittedSurface>& surfaces,
                  const SweepOptions& options) {
  assert(scene.sweep);
  EquilibriumSolver solver(build_model(scene, surfaces), equilibrium_options(scene, options));
  return sweep(solver, *scene.sweep, options);
}

}  // namespace condyle
