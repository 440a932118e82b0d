#include "condyle/network/contact_detection.h"

#include <fmt/format.h>

#include <algorithm>

#include "condyle/contact/contact.h"
#include "condyle/equilibrium/model_covers.h"

namespace condyle {
namespace {

// Of the length of the pair, 30 mm for a knee.
constexpr double kNear = 0.1 / 30;       // gap below which a place is followed
constexpr double kSamePlace = 0.5 / 30;  // between points of contact
constexpr double kDouble = 1e-3 / 30;    // between those that have become one
constexpr double kOverlap = 1e-6 / 30;   // of an open contact
constexpr double kBuried = 0.05 / 30;    // where there is no single lowest point

}  // namespace

KneeContactDetection::KneeContactDetection(const Model& model,
                                           const ContactCovers& covers,
                                           const KneeNetwork& knee)
    : model_(model), knee_(knee), searches_(make_searches(model, covers)) {}

void KneeContactDetection::forget() {
  for (ContactSearch& search : searches_) search.reset();
}

DetectedContacts KneeContactDetection::operator()(NetworkState& state) {
  DetectedContacts detected;
  for (std::size_t p = 0; p < model_.pairs.size(); ++p) {
    if (model_.pairs[p].mode == ContactMode::kOpen || !searches_[p].has_samples()) continue;
    detect_in_pair(static_cast<int>(p), state, detected);
  }
  detected.lost = lost_contact(state);
  if (detected.lost.empty()) detected.lost = lost_layer(state);
  return detected;
}

std::string beyond_edge(const ContactPair& pair, double edge_distance) {
  if (edge_distance >= 0) return "";
  return fmt::format("contact \"{}\" lies {:.2g} mm beyond the edge of its surface", pair.name,
                     -edge_distance);
}

std::string KneeContactDetection::lost_contact(const NetworkState& state) const {
  for (std::size_t i = 0; i < knee_.places.size(); ++i) {
    const MovingContact& contact = state.contacts[i];
    if (!contact.closed) continue;
    const ContactPair& pair = model_.pairs[knee_.places[i]];
    std::string reason = beyond_edge(pair, edge_distance(pair, contact.places));
    if (!reason.empty()) return reason;
  }
  return "";
}

std::string KneeContactDetection::lost_layer(const NetworkState& state) {
  for (const PotentialComponent& contact : knee_.network.potentials) {
    clear(described_);
    const std::optional<Objection> objection =
        contact.potential->describe(state.bodies[0].X, described_);
    if (objection) return objection->reason;
  }
  return "";
}

void KneeContactDetection::detect_in_pair(int pair,
                                          NetworkState& state,
                                          DetectedContacts& detected) {
  const double L = length_of(pair);
  drop_doubles(pair, state);
  set_known(pair, state);
  searches_[pair].find(state.bodies[0].X, kNear * L, minima_, kSamePlace * L, known_);
  for (const GapMinimum& minimum : minima_) {
    if (minimum.edge < 0) continue;
    const int follower = follower_of(pair, minimum, state);
    if (follower >= 0) {
      if (state.contacts[follower].closed || minimum.gap > -kOverlap * L) continue;
      detected.followed = std::min(detected.followed, minimum.gap);
      detected.overlapping.push_back(follower);
      continue;
    }
    if (!minimum.refined && minimum.gap > -kBuried * L) continue;
    detected.unseen = std::min(detected.unseen, minimum.gap);
    const int waiting = waiting_contact(pair, state);
    if (minimum.refined && waiting >= 0) state.contacts[waiting] = {minimum.places};
  }
}

/// Closed contacts are a help to the search, and need not be found.
void KneeContactDetection::set_known(int pair, const NetworkState& state) {
  known_.clear();
  for (std::size_t i = 0; i < knee_.places.size(); ++i) {
    const MovingContact& contact = state.contacts[i];
    if (knee_.places[i] != pair || !contact.closed) continue;
    known_.push_back(
        known_contact(linearize_contact(model_.pairs[pair], contact.places, state.bodies[0].X)));
  }
}

Eigen::Vector3d KneeContactDetection::point_of(int contact, const NetworkState& state) const {
  const ContactPair& pair = model_.pairs[knee_.places[contact]];
  return pair.on_B->evaluate_frame(state.contacts[contact].places.on_B).c;
}

int KneeContactDetection::follower_of(int pair,
                                      const GapMinimum& minimum,
                                      const NetworkState& state) const {
  for (int i = 0; i < static_cast<int>(knee_.places.size()); ++i)
    if (knee_.places[i] == pair && state.contacts[i].followed &&
        (point_of(i, state) - minimum.point_B).norm() < kSamePlace * length_of(pair))
      return i;
  return -1;
}

int KneeContactDetection::waiting_contact(int pair, const NetworkState& state) const {
  for (int i = 0; i < static_cast<int>(knee_.places.size()); ++i)
    if (knee_.places[i] == pair && !state.contacts[i].followed) return i;
  return -1;
}

/// Two minima that have become one need one contact, a closed one where there is one.
void KneeContactDetection::drop_doubles(int pair, NetworkState& state) const {
  const int count = static_cast<int>(knee_.places.size());
  for (int i = 0; i < count; ++i) {
    for (int k = i + 1; k < count; ++k) {
      MovingContact &first = state.contacts[i], &second = state.contacts[k];
      if (knee_.places[i] != pair || knee_.places[k] != pair) continue;
      if (!first.followed || !second.followed) continue;
      if ((point_of(i, state) - point_of(k, state)).norm() > kDouble * length_of(pair)) continue;
      MovingContact& dropped = second.closed && !first.closed ? first : second;
      dropped.closed = dropped.followed = false;
    }
  }
}

}  // namespace condyle
