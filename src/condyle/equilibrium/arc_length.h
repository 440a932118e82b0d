#pragma once

/// Follows the path of equilibria of one swept value by its own length, through limit points, where
/// the path turns back and a sweep in steps would jump.
///
/// Predictor along the tangent, corrector at right angles to it (path_system.h), steps halved where
/// that fails. A contact that would pull is released and an overlap becomes a contact at the place
/// where that happens, found by bisection; the new branch is taken in the direction in which the
/// gap opens or the contact pushes. Where a ligament comes to lie on a surface or leaves it the path has a corner.

#include "condyle/equilibrium/equilibrium_solver.h"
#include "condyle/equilibrium/path_options.h"

namespace condyle {

/// Poses in the order of the path, from `from` (solved as any first pose, or from the solver's
/// state) to `to`, no two farther apart than 1.5 `largest_step` of the swept value. The swept value may
/// go back and beyond both. The last pose lies at `to` exactly; where the path cannot be followed
/// so far the last pose says why. Events of contacts and ligaments, and limit points, are located and stand in
/// the order of the path.
[[nodiscard]] SweepResult follow_path(EquilibriumSolver& solver,
                                      const Swept& swept,
                                      double from,
                                      double to,
                                      double largest_step,
                                      const PathOptions& options = {});

}  // namespace condyle
