#include "condyle/contact/contact_potentials.h"

#include <algorithm>
#include <stdexcept>

namespace condyle {

ContactPotentials::ContactPotentials(const std::vector<ContactPair>& pairs) {
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    if (!pairs[p].law) continue;
    if (pairs[p].mode != ContactMode::kOpen)
      throw std::invalid_argument("contact \"" + pairs[p].name +
                                  "\" has a law of its own and rigid points too, expected the mode "
                                  "that leaves these out");
    entries_.push_back({p, pairs[p].law(pairs[p])});
  }
}

ContactPotential* ContactPotentials::of(std::size_t pair) const {
  for (const Entry& entry : entries_)
    if (entry.pair == pair) return entry.potential.get();
  return nullptr;
}

void ContactPotentials::reset() {
  for (const Entry& entry : entries_) entry.potential->reset();
}

void ContactPotentials::prepare(const RigidTransform& X_BA) {
  for (const Entry& entry : entries_) entry.potential->prepare(X_BA);
}

void ContactPotentials::soften(double factor) {
  for (const Entry& entry : entries_) entry.potential->soften(factor);
}

double ContactPotentials::softest(double force, double L) const {
  double factor = 1;
  for (const Entry& entry : entries_) factor = std::min(factor, entry.potential->softest(force, L));
  return factor;
}

bool ContactPotentials::accept(const RigidTransform& X_BA) {
  bool accepted = true;
  for (const Entry& entry : entries_) accepted &= entry.potential->accepts(X_BA);
  return accepted;
}

double ContactPotentials::add_to(const RigidTransform& X_BA, Wrench& wrench) {
  double magnitudes = 0;
  for (const Entry& entry : entries_) magnitudes += entry.potential->add_to(X_BA, wrench);
  return magnitudes;
}

double ContactPotentials::add_roughly_to(const RigidTransform& X_BA, Wrench& wrench) {
  double magnitudes = 0;
  for (const Entry& entry : entries_) magnitudes += entry.potential->add_roughly_to(X_BA, wrench);
  return magnitudes;
}

long ContactPotentials::looked_at() const {
  long points = 0;
  for (const Entry& entry : entries_) points += entry.potential->looked_at();
  return points;
}

double ContactPotentials::energy(const RigidTransform& X_BA) {
  double energy = 0;
  for (const Entry& entry : entries_) energy += entry.potential->energy(X_BA);
  return energy;
}

}  // namespace condyle
