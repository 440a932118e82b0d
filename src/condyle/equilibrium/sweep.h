#pragma once

/// The sweep: positions of equilibrium over a range of a prescribed motion or a load, each from the
/// last one that converged. It takes over what an earlier sweep left.
///
/// Values at which none was found are tried again from the next pose that converges, back towards
/// them; only then are they told. Where the poses on either side of such a gap, of a jump or of a
/// pose found from another start are followed into each other and do not meet, two positions of
/// equilibrium exist, and the remark of the pose says so.

#include <vector>

#include "condyle/equilibrium/equilibrium_solver.h"
#include "condyle/equilibrium/pose_result.h"
#include "condyle/equilibrium/sweep_options.h"
#include "condyle/scene/fitted_surface.h"
#include "condyle/scene/scene.h"

namespace condyle {

/// Solves the values in order. `swept` says which number of the drive varies. Never throws for mathematics that does not succeed: a pose carries its status. Whether poses are examined for
/// stability is the solver's option here.
[[nodiscard]] SweepResult sweep(EquilibriumSolver& solver,
                                const Swept& swept,
                                const std::vector<double>& values,
                                const SweepOptions& options = {});

/// The sweep that a scene asks for, by a solver of its model: in steps, or along the path of equilibria (arc_length.h),
/// which takes nothing over.
[[nodiscard]] SweepResult sweep(EquilibriumSolver& solver,
                                const SweepDescription& description,
                                const SweepOptions& options = {});
/// What is told of the poses of such a sweep.
[[nodiscard]] EquilibriumOptions equilibrium_options(const Scene& scene,
                                                     const SweepOptions& options = {});

/// One door: the sweep that the scene asks for. `surfaces` as from fit_surfaces.
[[nodiscard]] SweepResult sweep(const Scene& scene,
                                const std::vector<FittedSurface>& surfaces,
                                const SweepOptions& options = {});

}  // namespace condyle
