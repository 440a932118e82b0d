#pragma once

/// How the two surfaces of a pair carry. Rigid points of contact (contact.h) are the law of a pair
/// that names no other: they are unknowns of Newton's system, each with a row. A law without
/// unknowns is an energy U of the pose, a ContactPotential: its wrench -∂U and the derivatives of
/// that are added to those of ligaments and loads, and so are seen by Newton, descent, stability and
/// joint stiffness. A model may have pairs of either kind.

#include <functional>
#include <limits>
#include <memory>
#include <optional>

#include "condyle/contact/contact_result.h"
#include "condyle/contact/pose_status.h"
#include "condyle/elements/wrench.h"
#include "condyle/math/rigid_transform.h"

namespace condyle {

struct ContactPair;
struct ContactRates;

/// Of one pair and one thread: it may keep places from pose to pose. Nothing but prepare, accepts and refines
/// changes what is computed at a pose, and after reset, and of
/// what is held after forget_places, no bit depends on what was asked before.
class ContactPotential {
 public:
  virtual ~ContactPotential() = default;

  /// As newly made. Allocates nothing.
  virtual void reset() {}

  /// What prepare and accepts chose stays; of places, nothing is kept. Allocates nothing.
  virtual void forget_places() {}

  /// Chooses at a pose what is held while poses near it are solved: a quadrature, say.
  virtual void prepare(const RigidTransform& /*X_BA*/) {}

  /// At a pose that has been solved: false where what is held had to be changed; then the pose is
  /// solved on.
  virtual bool accepts(const RigidTransform& /*X_BA*/) { return true; }

  /// What is held becomes as fine as a pose asks for, never coarser: false where it had to be changed.
  virtual bool refines(const RigidTransform& /*X_BA*/) { return true; }

  /// How wrong at a pose what is held makes the force, for describe to tell; accepts knows it too.
  virtual void estimate_error(const RigidTransform& /*X_BA*/) {}

  /// Until told otherwise it is `factor` times as stiff as it is: a way to poses that Newton does
  /// not find at once. Allocates nothing.
  virtual void soften(double /*factor*/) {}

  /// The factor, at most 1, that leaves it so stiff that a force [N] makes it give way by about
  /// L/60 on an area of (L/3)², L [mm] being the size of the joint.
  [[nodiscard]] virtual double softest(double /*force*/, double /*L*/) const { return 1; }

  /// Adds the wrench on A with its exact derivatives to `wrench`; returns the sum of the forces'
  /// magnitudes [N]. Finite at every pose. Allocates nothing once it was asked.
  virtual double add_to(const RigidTransform& X_BA, Wrench& wrench) = 0;

  /// The same as well as a step of Newton's method asks for, where that costs less.
  virtual double add_roughly_to(const RigidTransform& X_BA, Wrench& wrench) {
    return add_to(X_BA, wrench);
  }

  /// Points that it looked at since it was made, about, by the time that one takes a search
  /// (ContactSearch::looked_at).
  [[nodiscard]] virtual long looked_at() const { return 0; }

  /// U [N mm], 0 where nothing touches.
  virtual double energy(const RigidTransform& X_BA) = 0;

  /// Does it say how its resultant moves and what stiffer layers do (contact_rates.h)?
  [[nodiscard]] virtual bool knows_rates() const { return false; }
  /// False where it does not know, or nothing is pressed. Allocates nothing once it was asked.
  virtual bool rates(const RigidTransform& /*X_BA*/, ContactRates& /*rates*/) { return false; }

  /// So deep the surfaces may overlap anywhere by this law [mm].
  [[nodiscard]] virtual double bears() const { return std::numeric_limits<double>::infinity(); }

  /// Fills a cleared result, in the model's frames: closed where it carries, with force, resultant
  /// and a point where it presses most; else the nearest point. Says why a pose with such a contact
  /// is none, if it is.
  virtual std::optional<Objection> describe(const RigidTransform& X_BA, ContactResult& result) = 0;

  /// Of a pose of equilibrium: is the force too uncertain for those that act, of which `acting` is the sum of magnitudes
  /// [N]?
  virtual std::optional<Objection> uncertain(const RigidTransform& /*X_BA*/, double /*acting*/) {
    return std::nullopt;
  }
};

/// Makes the potential of a pair in the model's frames; what it shares between threads is constant.
/// Empty: rigid points.
using ContactLaw = std::function<std::unique_ptr<ContactPotential>(const ContactPair& pair)>;

}  // namespace condyle
