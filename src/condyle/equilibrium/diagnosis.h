#pragma once

/// Why a pose has no equilibrium, in words: a status and one line that names what is to blame.

#include <string>

#include "condyle/equilibrium/attempt.h"
#include "condyle/equilibrium/pose_result.h"

namespace condyle {

/// What has a force that is no number at a state; empty where all are finite. `system` belongs to
/// the model, and is not assembled anew.
[[nodiscard]] std::string overflowed(const Model& model,
                                     NewtonSystem& system,
                                     const EquilibriumState& state,
                                     const Drive& drive);

/// Where Newton last stopped, for a singular matrix: what depends on what, or which motion is free.
[[nodiscard]] std::string why_singular(Newton& newton);

/// Sets result.status and result.reason. `state` is the last that was tried from the pose before on
/// the way to `drive`, `singular` why Newton's matrix was there, or empty; `system` belongs to the
/// model and may be assembled anew; `searches`: one for each pair.
void explain_failure(const Model& model,
                     NewtonSystem& system,
                     std::vector<ContactSearch>& searches,
                     const EquilibriumState& state,
                     const Drive& drive,
                     const Attempt& attempt,
                     std::string singular,
                     PoseResult& result);

}  // namespace condyle
