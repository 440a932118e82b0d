#include "condyle/network/settle_contacts.h"

#include <algorithm>
#include <cmath>

#include "condyle/contact/settle_places.h"
#include "condyle/math/rotation.h"

namespace condyle {
namespace {

// Of L, from where a contact was settled last:
constexpr double kReach = 1.0 / 3;
constexpr double kFarReach = 10;  // of an open one

/// Where the contact slides to, to first order, from where it was settled last.
void extrapolate(const SurfacePair& surfaces,
                 const RigidTransform& X,
                 double L,
                 const SettledContact& last,
                 ContactPlaces& places) {
  constexpr double kLongest = 1.0 / 30;  // of L
  if (places != last.places) return;
  slide_contact(surfaces, places, last.at, last.X, X.p - last.X.p,
                cayley_vector(X.R * last.X.R.transpose()), kLongest * L);
}

}  // namespace

bool settle_contact(const ContactComponent& contact,
                    const RigidTransform& X,
                    double L,
                    MovingContact& state,
                    SettledContact& settled) {
  const SurfacePair surfaces = contact.surfaces();
  const auto settle = [&](ContactPlaces& places, const Settling& how) {
    return settle_places(surfaces, X, how, places, settled.at) == Settled::kThere &&
           are_opposite(settled.at);
  };
  ContactPlaces trial = state.places;
  extrapolate(surfaces, X, L, settled, trial);
  bool found = settle(trial, {kReach * L});
  // Beyond the middle of a cup the place that was nearest is the farthest one: downhill from there.
  if (!found && !state.closed && !contact.is_detected)
    found = settle(trial = state.places, {kFarReach * L, true});
  if (!found) {
    settled.places.on_B.numbers.setConstant(NAN);
    if (state.closed || !contact.is_detected) return false;
    state.followed = false;
    return true;
  }
  state.places = trial;
  settled.X = X;
  settled.places = state.places;
  return true;
}

bool settle_contacts(const Network& network,
                     bool open_ones_too,
                     NetworkState& state,
                     std::vector<SettledContact>& settled) {
  settled.resize(network.contacts.size());
  for (std::size_t i = 0; i < network.contacts.size(); ++i) {
    MovingContact& own = state.contacts[i];
    if (!own.followed || !(own.closed || open_ones_too)) continue;
    const ContactComponent& contact = network.contacts[i];
    const RigidTransform& X = state.bodies[contact.body].X;
    if (!settle_contact(contact, X, network.length, own, settled[i])) return false;
  }
  return true;
}

}  // namespace condyle
