#include "equilibrium/contact_rules.h"

#include <algorithm>

#include "equilibrium/contact_scales.h"

namespace condyle {
namespace {

constexpr double kSpacing = 0.04;       // of contact samples, in units of L
constexpr double kOverlap = 5e-7 / 30;  // that a converged pose may have, in units of L
constexpr double kPull = 1e-12;         // round-off, of all forces

}  // namespace

ContactRules::ContactRules(const Model& model) : model_(model) {
  searches_.reserve(model.pairs.size());
  for (const ContactPair& pair : model.pairs) searches_.emplace_back(pair, kSpacing * model.length);
}

Fault ContactRules::fault(const NewtonSystem& system, const EquilibriumState& state) {
  Fault fault;
  double lowest = -kPull * system.force_scale();
  for (std::size_t k = 0; k < state.contacts.size(); ++k) {
    const ClosedContact& contact = state.contacts[k];
    if (pair_of(contact).mode == ContactMode::kClosed || contact.p >= lowest) continue;
    fault.pulling = static_cast<int>(k);
    lowest = contact.p;
  }
  if (fault.pulling < 0) fault.overlap = overlap(state);
  return fault;
}

std::optional<ClosedContact> ContactRules::overlap(const EquilibriumState& state) {
  std::optional<ClosedContact> deepest;
  double lowest = -kOverlap * model_.length;
  for (std::size_t p = 0; p < searches_.size(); ++p) {
    if (model_.pairs[p].mode != ContactMode::kAuto) continue;
    searches_[p].find(state.X, 0.0, minima_, kMerge * model_.length);
    for (const GapMinimum& minimum : minima_) {
      if (minimum.gap >= lowest || is_known(state, static_cast<int>(p), minimum)) continue;
      lowest = minimum.gap;
      deepest = ClosedContact{static_cast<int>(p), minimum.on_B, minimum.on_A, 0};
    }
  }
  return deepest;
}

bool ContactRules::is_known(const EquilibriumState& state,
                            int pair,
                            const GapMinimum& minimum) const {
  const double near = kMerge * model_.length;
  return std::any_of(state.contacts.begin(), state.contacts.end(),
                     [&](const ClosedContact& contact) {
                       const Surface& on_B = *pair_of(contact).on_B;
                       return contact.pair == pair && minimum.gap > -1e-3 * near &&
                              (on_B.evaluate(contact.on_B).c - minimum.point_B).norm() < near;
                     });
}

const ContactPair& ContactRules::pair_of(const ClosedContact& contact) const {
  return model_.pairs[static_cast<std::size_t>(contact.pair)];
}

}  // namespace condyle
