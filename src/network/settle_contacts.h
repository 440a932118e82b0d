#pragma once

/// The places of contacts at a given motion: where the gap is smallest near the places before.

#include "elements/contact.h"
#include "network/network.h"

namespace condyle {

/// Brings the places of all contacts to where the gap is smallest near them, and gives the contacts
/// linearised there, one each; of one that waits nothing is said. False where that does not settle.
[[nodiscard]] bool settle_contacts(const Network& network,
                                   NetworkState& state,
                                   std::vector<ContactLinearization>& settled);

}  // namespace condyle
