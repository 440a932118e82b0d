#include "condyle/equilibrium/arc_length.h"

#include "condyle/equilibrium/path_follower.h"

namespace condyle {

SweepResult follow_path(EquilibriumSolver& solver,
                        const Swept& swept,
                        double from,
                        double to,
                        double largest_step,
                        const PathOptions& options) {
  const Drive drive = options.drive ? *options.drive : drive_of(solver.model());
  check_drive(drive, solver.model());
  if (from == to || !(largest_step > 0)) {
    SweepResult single;
    single.poses.push_back(solver.solve(swept.with(drive, from)));
    single.poses.back().value = from;
    return single;
  }
  return PathFollower(solver, swept, drive, from, to, largest_step, options).follow();
}

}  // namespace condyle
