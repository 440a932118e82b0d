#pragma once

/// Limit points at corners of a path of equilibria: where a point of contact opens or closes, the branch with the
/// other contacts may lead back to where the swept value came from (snap-through).

#include "condyle/equilibrium/path_system.h"
#include "condyle/equilibrium/walker.h"

namespace condyle {

/// Does the path turn back between two poses close to each other, in one of which one point of contact more carries?
/// On from `after` along its tangent, with the swept value going as from `before` to `after`, a gap that has opened
/// falls, or the force of a contact that has closed. False where anything else differs, and for contacts with a law
/// of force, which change without a corner.
[[nodiscard]] bool turns_back(PathSystem& path,
                              const Model& model,
                              const SolvedPose& before,
                              const SolvedPose& after);

}  // namespace condyle
