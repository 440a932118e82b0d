#pragma once

/// Why a pose has no equilibrium, in words: a status and one line that names what is to blame.

#include "equilibrium/attempt.h"
#include "equilibrium/pose_result.h"

namespace condyle {

/// Sets result.status and result.reason. `state` is the last that was tried; `system` belongs to
/// the model and may be assembled anew; `searches`: one for each pair.
void explain_failure(const Model& model,
                     NewtonSystem& system,
                     std::vector<ContactSearch>& searches,
                     const EquilibriumState& state,
                     const Attempt& attempt,
                     PoseResult& result);

}  // namespace condyle
