#pragma once

/// How the force of a law changes with the law's own numbers at a fixed length.

#include <optional>

#include "condyle/elements/force_law.h"

namespace condyle {

struct LawRates {
  double slack_length = 0;       ///< ∂f/∂l₀ [N/mm]
  double stiffness = 0;          ///< ∂f/∂k [N per unit of k]
  double transition_strain = 0;  ///< ∂f/∂ε_t [N]; 0 for a law that has none
};

/// Of toe-linear and quadratic laws at L [mm], L > 0; nothing of others. Continuous where the element
/// is at its slack length and where the toe ends.
[[nodiscard]] std::optional<LawRates> law_rates(const ForceLaw& law, double length);

/// Does nothing to laws that have no slack length.
void set_slack_length(ForceLaw& law, double slack_length);

}  // namespace condyle
