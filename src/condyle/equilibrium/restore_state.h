#pragma once

/// From a pose as it was told back to the state that the solver goes on from.

#include "condyle/equilibrium/newton.h"
#include "condyle/equilibrium/pose_result.h"

namespace condyle {

/// Does the pose tell enough: where the moving body is, and its contacts and multipliers?
[[nodiscard]] bool can_restore(const Model& model, const PoseResult& pose);

/// The state of a pose for which can_restore holds. The places on the surfaces are found again from
/// the points of contact; forces and multipliers are taken as they are.
[[nodiscard]] EquilibriumState restore_state(const Model& model, const PoseResult& pose);

}  // namespace condyle
