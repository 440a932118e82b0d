#include "condyle/equilibrium/closing_event.h"

#include <algorithm>
#include <cmath>

#include "condyle/contact/contact_scales.h"
#include "condyle/contact/settle_places.h"

namespace condyle {
namespace {

// Of the length of the pair, that a point of contact moves between two poses.
constexpr double kNearby = 0.1;

/// Does the state carry at that place of that pair, whose length is `length`?
bool carries_at(const ContactPair& pair,
                double length,
                const EquilibriumState& state,
                const ClosedContact& contact) {
  const Surface& on_B = *pair.on_B;
  const Eigen::Vector3d point = on_B.evaluate(contact.places.on_B).c;
  return std::any_of(state.contacts.begin(), state.contacts.end(), [&](const ClosedContact& c) {
    return c.pair == contact.pair &&
           (on_B.evaluate(c.places.on_B).c - point).norm() < kMerge * length;
  });
}

/// The lowest gap near the places of a contact, at another pose [mm].
std::optional<double> gap_near(const ContactPair& pair,
                               double length,
                               const ClosedContact& contact,
                               const RigidTransform& X_BA) {
  ContactPlaces places = contact.places;
  ContactLinearization at;
  if (settle_places(pair, X_BA, {kNearby * length, true}, places, at) != Settled::kThere)
    return std::nullopt;
  return at.gap();
}

}  // namespace

std::optional<double> closing_value(const Model& model,
                                    const std::vector<ContactSearch>& searches,
                                    const SolvedPose& earlier,
                                    const SolvedPose& before,
                                    const SolvedPose& after) {
  const double step = before.value - earlier.value;
  std::optional<double> nearest;
  for (const ClosedContact& contact : after.state.contacts) {
    const ContactPair& pair = model.pairs[static_cast<std::size_t>(contact.pair)];
    const double length = searches[static_cast<std::size_t>(contact.pair)].length(model.length);
    if (carries_at(pair, length, before.state, contact)) continue;
    const std::optional<double> first = gap_near(pair, length, contact, earlier.state.X);
    const std::optional<double> last = gap_near(pair, length, contact, before.state.X);
    if (!first || !last || !(*first > *last)) continue;
    const double way = *last / (*first - *last) * step;
    if (std::abs(way) > std::abs(step)) continue;
    if (!nearest || std::abs(way) < std::abs(*nearest - before.value)) nearest = before.value + way;
  }
  return nearest;
}

}  // namespace condyle
