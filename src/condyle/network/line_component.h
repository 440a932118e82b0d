#pragma once

/// What a line element or damper does at a length and its rate.

#include "condyle/network/network.h"

namespace condyle {

struct LineState {
  double length = 0, rate = 0;   ///< [mm], [mm/s]
  double force = 0, energy = 0;  ///< [N], [N mm]
  double dissipation = 0;        ///< [N mm/s]
};
[[nodiscard]] LineState line_state(const LineComponent& line, double length, double rate);

}  // namespace condyle
