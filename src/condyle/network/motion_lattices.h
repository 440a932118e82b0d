#pragma once

/// What contacts with a law of their own hold while a network moves: an energy is kept only as long as
/// it is one function of the pose, so a motion has one lattice from its start to its end.

#include "condyle/network/motion.h"

namespace condyle {

/// Chooses them at the pose of the body at the start.
void choose_lattices(const RigidTransform& start, Network& network);

/// What made one of them finer: what a pose asks for.
struct LatticeRefinement {
  std::size_t potential = 0;  ///< of Network::potentials
  RigidTransform at;          ///< pose of its body
};
/// Throws InputError for a potential that the network does not have.
void refine_lattice(const LatticeRefinement& refinement, Network& network);

/// None where they are fine enough at the frame in which their contact presses most, relative to the force
/// there. Else these lattices are finer now, and the motion has to be computed anew.
[[nodiscard]] std::vector<LatticeRefinement> refine_lattices(const Motion& motion,
                                                             Network& network);

/// What they hold stays; what was asked of them before is forgotten to the last bit.
void forget_places(const Network& network);

}  // namespace condyle
