#include "condyle/network/motion_lattices.h"

#include "condyle/input_error.h"

namespace condyle {
namespace {

/// The frame at which a contact presses most, or null where it never does.
const RigidTransform* most_pressed(const Motion& motion, const PotentialComponent& contact) {
  const RigidTransform* most = nullptr;
  double greatest = 0;
  for (const MotionFrame& frame : motion.frames) {
    const RigidTransform& X = frame.state.bodies[contact.body].X;
    Wrench wrench;
    const double force = contact.potential->add_to(X, wrench);
    if (!(force > greatest)) continue;
    greatest = force;
    most = &X;
  }
  return most;
}

}  // namespace

void choose_lattices(const RigidTransform& start, Network& network) {
  for (const PotentialComponent& contact : network.potentials) {
    contact.potential->prepare(start);
    while (!contact.potential->accepts(start)) {
    }
  }
}

void refine_lattice(const LatticeRefinement& refinement, Network& network) {
  if (refinement.potential >= network.potentials.size())
    throw InputError("network: a lattice of an earlier run is of no contact of this one");
  ContactPotential& potential = *network.potentials[refinement.potential].potential;
  potential.forget_places();
  (void)potential.refines(refinement.at);
}

std::vector<LatticeRefinement> refine_lattices(const Motion& motion, Network& network) {
  std::vector<LatticeRefinement> refined;
  for (std::size_t i = 0; i < network.potentials.size(); ++i) {
    const PotentialComponent& contact = network.potentials[i];
    const RigidTransform* X = most_pressed(motion, contact);
    if (X == nullptr) continue;
    contact.potential->forget_places();  // so that whoever refines to this pose comes to the same
    if (!contact.potential->refines(*X)) refined.push_back({i, *X});
  }
  return refined;
}

void forget_places(const Network& network) {
  for (const PotentialComponent& contact : network.potentials) contact.potential->forget_places();
}

}  // namespace condyle
