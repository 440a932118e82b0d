#pragma once

#include "condyle/equilibrium/sweep.h"

namespace condyle {

[[nodiscard]] inline SweepOptions without_events() {
  SweepOptions options;
  options.events = false;
  return options;
}

}  // namespace condyle
