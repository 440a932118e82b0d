#pragma once

/// The contact laws without unknowns of a model (contact_law.h), asked together.

#include <memory>
#include <vector>

#include "condyle/contact/contact_pair.h"

namespace condyle {

/// The potentials of a model's pairs, of one thread: none where all are rigid.
class ContactPotentials {
 public:
  /// Throws std::invalid_argument where a pair with a law of its own is to have rigid points too
  /// (its mode is not kOpen).
  explicit ContactPotentials(const std::vector<ContactPair>& pairs);

  [[nodiscard]] bool empty() const { return entries_.empty(); }
  /// Null for a pair of rigid points.
  [[nodiscard]] ContactPotential* of(std::size_t pair) const;

  void reset();
  void prepare(const RigidTransform& X_BA);
  void soften(double factor);
  [[nodiscard]] double softest(double force, double L) const;
  [[nodiscard]] bool accept(const RigidTransform& X_BA);
  double add_to(const RigidTransform& X_BA, Wrench& wrench);
  double add_roughly_to(const RigidTransform& X_BA, Wrench& wrench);
  [[nodiscard]] double energy(const RigidTransform& X_BA);
  [[nodiscard]] long looked_at() const;

 private:
  struct Entry {
    std::size_t pair;
    std::unique_ptr<ContactPotential> potential;
  };
  std::vector<Entry> entries_;
};

}  // namespace condyle
