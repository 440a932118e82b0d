#include "condyle/network/line_component.h"

#include <algorithm>
#include <variant>

namespace condyle {

LineState line_state(const LineComponent& line, double length, double rate) {
  LineState s{length, rate, 0, 0, 0};
  double elastic = 0, viscous = line.damping * rate;
  if (line.law) {
    const auto* toe_linear = std::get_if<ToeLinearLaw>(&*line.law);  // what most ligaments have
    const Tension t = toe_linear ? tension(*toe_linear, length) : tension(*line.law, length);
    elastic = t.force;
    s.energy = t.energy;
    if (line.viscous_time > 0) {
      double share = line.viscous_time * t.slope * rate;
      if (elastic >= 0) share = std::max(share, -elastic);
      viscous += share;
    }
  }
  s.force = elastic + viscous;
  s.dissipation = viscous * rate;
  return s;
}

}  // namespace condyle
