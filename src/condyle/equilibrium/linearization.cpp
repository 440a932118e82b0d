#include "condyle/equilibrium/linearization.h"

#include <algorithm>
#include <stdexcept>

namespace condyle {

Linearization linearization(const NewtonSystem& system,
                            const EquilibriumState& state,
                            const Drive& drive) {
  if (!system.is_assembled_at(state))
    throw std::invalid_argument("the system was last assembled at another state");
  return {system.model(), state, drive, system};
}

void fill_drive_column(const Linearization& at, const Swept& swept, double* column) {
  (void)swept.in(at.drive);
  std::fill(column, column + 6 + at.constraints(), 0.0);
  if (!swept.is_load()) {
    column[6 + at.contacts().size() + swept.index] = -condition_weight(at.model, swept.index);
    return;
  }
  Wrench wrench;
  add_load(at.system.parameters().loads[swept.index], 1, at.state.X, wrench);
  for (int i = 0; i < 3; ++i) {
    column[i] = wrench.f[i];
    column[3 + i] = wrench.m[i] / at.model.length;
  }
}

}  // namespace condyle
