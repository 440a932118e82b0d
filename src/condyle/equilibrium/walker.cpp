#include "condyle/equilibrium/walker.h"

namespace condyle {

Walker::Walker(EquilibriumSolver& solver, const Swept& swept, const Drive& drive)
    : solver_(solver), swept_(swept), drive_(drive) {
  check_drive(drive_, solver.model());
}

const Drive& Walker::drive_at(double value) {
  swept_.in(drive_) = value;
  return drive_;
}

void Walker::stand_at(double value, const EquilibriumState& state) {
  solver_.set_state(state, drive_at(value));
}

bool Walker::step(double value, Patience patience, SolvedPose& to) {
  solver_.solve(drive_at(value), to.result, patience);
  to.value = to.result.value = value;
  if (!to.result.solved()) return false;
  to.state = solver_.solution();
  return true;
}

}  // namespace condyle
