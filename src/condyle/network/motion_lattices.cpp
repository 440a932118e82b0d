#include "condyle/network/motion_lattices.h"

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

bool accept_lattices(const Motion& motion, Network& network) {
  bool accepted = true;
  for (const PotentialComponent& contact : network.potentials)
    if (const RigidTransform* X = most_pressed(motion, contact))
      accepted &= contact.potential->accepts(*X);
  return accepted;
}

}  // namespace condyle
