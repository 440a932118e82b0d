#pragma once

/// What contacts with a law of their own hold while a network moves: an energy is kept only as long as
/// it is one function of the pose, so a motion has one lattice from its start to its end.

#include "condyle/network/motion.h"

namespace condyle {

/// Chooses them at the pose of the body at the start.
void choose_lattices(const RigidTransform& start, Network& network);

/// False where they are too coarse at the frame in which their contact presses most, relative to the
/// force there. Then they are finer now, and the motion has to be computed anew.
[[nodiscard]] bool accept_lattices(const Motion& motion, Network& network);

}  // namespace condyle
