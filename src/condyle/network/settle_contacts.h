#pragma once

/// The places of contacts at a given motion: where the gap is smallest near the places before.

#include "condyle/contact/contact.h"
#include "condyle/network/network.h"

namespace condyle {

/// A contact linearised at a pose, from which the next places are extrapolated.
struct SettledContact {
  ContactLinearization at;
  RigidTransform X;
  ContactPlaces places = {{Eigen::Vector3d::Constant(NAN)}, {Eigen::Vector3d::Constant(NAN)}};
};

/// Brings the places of all contacts to where the gap is smallest near them, or only those of the
/// closed ones; of a contact that waits nothing is said. False where that does not settle.
[[nodiscard]] bool settle_contacts(const Network& network,
                                   bool open_ones_too,
                                   NetworkState& state,
                                   std::vector<SettledContact>& settled);

/// The same for one contact that is followed, of a network of length L [mm]; a detected one that is
/// lost waits.
[[nodiscard]] bool settle_contact(const ContactComponent& contact,
                                  const RigidTransform& X,
                                  double L,
                                  MovingContact& state,
                                  SettledContact& settled);

}  // namespace condyle
