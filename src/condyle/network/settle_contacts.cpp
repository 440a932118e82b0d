#include "condyle/network/settle_contacts.h"

#include <algorithm>
#include <cmath>

#include "condyle/math/rotation.h"

namespace condyle {
namespace {

constexpr double kFar = 1.0 / 30;  // gap, of L, beyond which an open contact is only followed

/// Closest points in turn: sure, and quick where the gap is wide. From moment to moment it gains.
bool settle_far(const SurfacePair& surfaces, const RigidTransform& X, ContactPlaces& places) {
  for (int turn = 0; turn < 3; ++turn) {
    const Eigen::Vector3d on_body = X * surfaces.on_A.evaluate_frame(places.on_A).c;
    places.on_B = surfaces.on_B.closest(on_body, places.on_B);
    const Eigen::Vector3d on_ground = surfaces.on_B.evaluate_frame(places.on_B).c;
    places.on_A = surfaces.on_A.closest(X.inverse() * on_ground, places.on_A);
  }
  return places.on_B.numbers.allFinite() && places.on_A.numbers.allFinite();
}

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

/// Newton on opposite normals and no tangential distance; it takes the surfaces to be near.
bool settle_near(const SurfacePair& surfaces,
                 const RigidTransform& X,
                 double L,
                 bool closed,
                 ContactPlaces& places,
                 ContactLinearization& at) {
  constexpr int kMostSteps = 20;
  constexpr double kSettled = 1e-12, kOneStepLeft = 1e-7;  // a step squares what is off
  const double unit = L / 30;                              // 1 mm on a knee
  for (int step = 0;; ++step) {
    at = linearize_contact(surfaces, places, X);
    const double gap = at.gap();
    if (!closed && gap > kFar * L) {
      if (!settle_far(surfaces, X, places)) return false;
      at = linearize_contact(surfaces, places, X);
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
    slide_contact(surfaces, places, at, X, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), L / 3);
    if (off < kOneStepLeft) {
      at = linearize_contact(surfaces, places, X);
      return true;
    }
  }
}

}  // namespace

bool settle_contact(const ContactComponent& contact,
                    const RigidTransform& X,
                    double L,
                    MovingContact& state,
                    SettledContact& settled) {
  const SurfacePair surfaces = contact.surfaces();
  ContactPlaces trial = state.places;
  extrapolate(surfaces, X, L, settled, trial);
  if (settle_near(surfaces, X, L, state.closed, trial, settled.at)) {
    state.places = trial;
  } else {
    settled.places.on_B.numbers.setConstant(NAN);
    if (state.closed) return false;
    if (contact.scouted) {
      state.followed = false;
      return true;
    }
    if (!settle_far(surfaces, X, state.places)) return false;
    settled.at = linearize_contact(surfaces, state.places, X);
  }
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
