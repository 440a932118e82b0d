#include "condyle/equilibrium/contact_rules.h"
#include "condyle/equilibrium/model_covers.h"

#include <algorithm>

#include "condyle/contact/contact_scales.h"

namespace condyle {
namespace {

constexpr double kOverlap = 5e-7 / 30;  // that a converged pose may have, in units of L
constexpr double kPull = 1e-12;         // round-off, of all forces

const ContactPair& pair_of(const Model& model, const ClosedContact& contact) {
  return model.pairs[static_cast<std::size_t>(contact.pair)];
}

}  // namespace

int most_pulling(const Model& model, const NewtonSystem& system, const EquilibriumState& state) {
  int worst = -1;
  double lowest = -kPull * system.force_scale();
  for (std::size_t k = 0; k < state.contacts.size(); ++k) {
    const ClosedContact& contact = state.contacts[k];
    if (pair_of(model, contact).mode == ContactMode::kClosed || contact.p >= lowest) continue;
    worst = static_cast<int>(k);
    lowest = contact.p;
  }
  return worst;
}

bool is_contact_of(const Model& model,
                   const EquilibriumState& state,
                   int pair,
                   const GapMinimum& minimum) {
  const double near = kMerge * model.length;
  return minimum.gap > -1e-3 * near &&
         std::any_of(state.contacts.begin(), state.contacts.end(),
                     [&](const ClosedContact& contact) {
                       const Surface& on_B = *pair_of(model, contact).on_B;
                       return contact.pair == pair &&
                              (on_B.evaluate(contact.on_B).c - minimum.point_B).norm() < near;
                     });
}

ContactRules::ContactRules(const Model& model, const ContactCovers& covers)
    : model_(model), searches_(make_searches(model, covers)) {}

Fault ContactRules::fault(const NewtonSystem& system, const EquilibriumState& state) {
  Fault fault;
  fault.pulling = most_pulling(model_, system, state);
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
      if (minimum.gap >= lowest || is_contact_of(model_, state, static_cast<int>(p), minimum))
        continue;
      lowest = minimum.gap;
      deepest = ClosedContact{static_cast<int>(p), minimum.on_B, minimum.on_A, 0};
    }
  }
  return deepest;
}

}  // namespace condyle
