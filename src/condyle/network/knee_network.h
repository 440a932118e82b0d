#pragma once

/// The knee of the equilibrium solver as a network: the moving bone is a body whose ports are the
/// insertions, contact points and load points, the femur is the ground. The one place of this room
/// that knows the solver's model.

#include "condyle/contact/contact_search.h"
#include "condyle/equilibrium/model.h"
#include "condyle/equilibrium/newton.h"
#include "condyle/network/network.h"

namespace condyle {

/// `mass` may be absent where only statics is asked. The reference port is the mass centre, or the
/// origin O_A where there is no mass. Contacts that the model leaves out are left out; `places`
/// says which of Model::pairs each contact of the network is: a pair has several
/// contacts, for the points at which its surfaces may touch at once; of one that is held closed the first
/// does not open. `potentials` says it of those with a law of their own.
struct KneeNetwork {
  Network network;
  std::vector<int> places, potentials;
};
[[nodiscard]] KneeNetwork make_knee_network(const Model& model,
                                            const std::optional<MassProperties>& mass);

inline constexpr int kPointsPerPair = 3;

/// The state of rest at a pose of the solver: its closed contacts closed. Of a pair that is open
/// the first contact starts from the nearest place that the solver's search finds; the others wait.
/// Throws InputError for a pair that touches in more than kPointsPerPair points.
[[nodiscard]] NetworkState state_at_rest(const Model& model,
                                         const ContactCovers& covers,
                                         const KneeNetwork& knee,
                                         const EquilibriumState& equilibrium);

}  // namespace condyle
