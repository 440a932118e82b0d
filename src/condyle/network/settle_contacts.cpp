#include "condyle/network/settle_contacts.h"

#include <algorithm>
#include <cmath>

#include "condyle/math/rotation.h"

namespace condyle {
namespace {

constexpr double kFar = 1.0 / 30;  // gap, of L, beyond which an open contact is only followed

/// Closest points in turn: sure, and quick where the gap is wide. From moment to moment it gains.
bool settle_far(const ContactComponent& contact, const RigidTransform& X, ContactPlaces& places) {
  for (int turn = 0; turn < 3; ++turn) {
    const Eigen::Vector3d on_body = X * contact.on_body->evaluate_frame(places.on_body).c;
    places.on_ground = contact.on_ground->closest(on_body, places.on_ground);
    const Eigen::Vector3d on_ground = contact.on_ground->evaluate_frame(places.on_ground).c;
    places.on_body = contact.on_body->closest(X.inverse() * on_ground, places.on_body);
  }
  return places.on_ground.numbers.allFinite() && places.on_body.numbers.allFinite();
}

ContactLinearization linearize(const ContactComponent& contact,
                               const RigidTransform& X,
                               const ContactPlaces& places) {
  return linearize_contact(*contact.on_ground, places.on_ground, *contact.on_body, places.on_body,
                           X);
}

/// Where the contact slides to, to first order, from where it was settled last.
void extrapolate(const ContactComponent& contact,
                 const RigidTransform& X,
                 double L,
                 const SettledContact& last,
                 ContactPlaces& places) {
  constexpr double kLongest = 1.0 / 30;  // of L
  if (places.on_ground != last.on_ground || places.on_body != last.on_body) return;
  slide_contact(*contact.on_ground, places.on_ground, *contact.on_body, places.on_body, last.at,
                last.X, X.p - last.X.p, cayley_vector(X.R * last.X.R.transpose()), kLongest * L);
}

/// Newton on opposite normals and no tangential distance; it takes the surfaces to be near.
bool settle_near(const ContactComponent& contact,
                 const RigidTransform& X,
                 double L,
                 ContactPlaces& places,
                 ContactLinearization& at) {
  constexpr int kMostSteps = 20;
  constexpr double kSettled = 1e-12, kOneStepLeft = 1e-7;  // a step squares what is off
  const double unit = L / 30;                              // 1 mm on a knee
  for (int step = 0;; ++step) {
    at = linearize(contact, X, places);
    const double gap = at.gap();
    if (!places.closed && gap > kFar * L) {
      if (!settle_far(contact, X, places)) return false;
      at = linearize(contact, X, places);
      return true;
    }
    const Eigen::Vector3d apart = at.g;
    at.g -= gap * at.B.n;  // only what lies in the tangent plane is slid
    const double off = std::max({at.g.norm() / unit, at.h.norm(), at.S0.norm() / unit});
    if (!std::isfinite(off) || step == kMostSteps) return false;
    if (off < kSettled) {
      at.g = apart;
      return true;
    }
    slide_contact(*contact.on_ground, places.on_ground, *contact.on_body, places.on_body, at, X,
                  Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), L / 3);
    if (off < kOneStepLeft) {
      at = linearize(contact, X, places);
      return true;
    }
  }
}

}  // namespace

bool settle_contact(const ContactComponent& contact,
                    const RigidTransform& X,
                    double L,
                    ContactPlaces& places,
                    SettledContact& settled) {
  ContactPlaces trial = places;
  extrapolate(contact, X, L, settled, trial);
  if (settle_near(contact, X, L, trial, settled.at)) {
    places = trial;
  } else {
    settled.on_ground.numbers.setConstant(NAN);
    if (places.closed) return false;
    if (contact.scouted) {
      places.followed = false;
      return true;
    }
    if (!settle_far(contact, X, places)) return false;
    settled.at = linearize(contact, X, places);
  }
  settled.X = X;
  settled.on_ground = places.on_ground;
  settled.on_body = places.on_body;
  return true;
}

bool settle_contacts(const Network& network,
                     bool open_ones_too,
                     NetworkState& state,
                     std::vector<SettledContact>& settled) {
  settled.resize(network.contacts.size());
  for (std::size_t i = 0; i < network.contacts.size(); ++i) {
    ContactPlaces& places = state.contacts[i];
    if (!places.followed || !(places.closed || open_ones_too)) continue;
    const ContactComponent& contact = network.contacts[i];
    const RigidTransform& X = state.bodies[contact.body].X;
    if (!settle_contact(contact, X, network.length, places, settled[i])) return false;
  }
  return true;
}

}  // namespace condyle
