#include "condyle/network/contact_changes.h"

#include <algorithm>
#include <cmath>

#include "condyle/network/project.h"

namespace condyle {
namespace {

constexpr double kTouching = 1e-6 / 30;  // gap, of L, below which a contact may carry

bool holds(const std::vector<int>& list, int item) {
  return std::find(list.begin(), list.end(), item) != list.end();
}

/// Contacts that may be open or closed at this moment.
std::vector<int> touching(const Network& network,
                          const NetworkEquations& equations,
                          const NetworkState& state,
                          const std::vector<int>& struck) {
  std::vector<int> list;
  for (std::size_t i = 0; i < network.contacts.size(); ++i) {
    if (!network.contacts[i].opens || !state.contacts[i].followed) continue;
    const int index = static_cast<int>(i);
    const bool touches = equations.contact(i).gap() < kTouching * network.length;
    if (state.contacts[i].closed || holds(struck, index) || touches) list.push_back(index);
  }
  return list;
}

void close_only(NetworkState& state, const std::vector<int>& list, unsigned subset) {
  for (std::size_t k = 0; k < list.size(); ++k)
    state.contacts[list[k]].closed = ((subset >> k) & 1U) != 0;
}

/// All subsets, larger ones first: what can be closed is tried closed.
std::vector<unsigned> subsets(std::size_t n) {
  std::vector<unsigned> all(std::size_t{1} << n);
  for (unsigned s = 0; s < all.size(); ++s) all[s] = s;
  std::stable_sort(all.begin(), all.end(), [](unsigned a, unsigned b) {
    return __builtin_popcount(a) > __builtin_popcount(b);
  });
  return all;
}

/// The velocity along the normal after the impact, from that before.
double rebound(double speed, const IntegrationOptions& options) {
  const double after = -options.restitution * speed;
  return after > options.least_rebound ? after : 0;
}

/// Impulses for the contacts of a subset; false where one would have to pull, or a contact left out
/// would go on approaching.
bool strike(NetworkEquations& equations,
            NetworkState& state,
            const std::vector<int>& list,
            const std::vector<double>& before,
            const IntegrationOptions& options) {
  const double no_speed = 1e-9 / 30 * equations.network().length;  // [mm/s]
  NetworkState trial = state;
  if (!equations.assemble(trial)) return false;
  const std::vector<ConstraintRow>& rows = equations.rows();
  Eigen::VectorXd after = equations.rates(), impulse;
  for (std::size_t k = 0; k < rows.size(); ++k)
    if (rows[k].contact >= 0 && equations.network().contacts[rows[k].contact].opens)
      after[static_cast<Eigen::Index>(k)] =
          rebound(std::min(0.0, before[rows[k].contact]), options);
  const Eigen::VectorXd change = equations.impact(after, impulse);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const bool pulls = impulse[static_cast<Eigen::Index>(k)] > 0;
    if (rows[k].contact >= 0 && holds(list, rows[k].contact) && pulls) return false;
  }
  add_twists(trial, change);
  if (!equations.assemble(trial)) return false;
  for (const int i : list)
    if (!trial.contacts[i].closed && equations.gap_rate(static_cast<std::size_t>(i)) < -no_speed)
      return false;
  state = trial;
  return true;
}

/// After an impact: what parts faster than a rebound that counts is open, what parts more slowly is
/// put at rest. Else two compartments would strike in turn without end, each knocking the other
/// loose.
void rest_slow_ones(NetworkEquations& equations,
                    NetworkState& state,
                    const std::vector<int>& list,
                    double least_rebound) {
  if (!equations.assemble(state)) return;
  for (const int i : list)
    state.contacts[i].closed = equations.gap_rate(static_cast<std::size_t>(i)) < least_rebound;
  if (equations.assemble(state)) add_twists(state, equations.velocity_correction());
}

/// The closed contacts by their forces; rebounding ones are open.
bool choose_closed(NetworkEquations& equations,
                   NetworkState& state,
                   const std::vector<int>& list,
                   double force_allowance) {
  for (const unsigned subset : subsets(list.size())) {
    close_only(state, list, subset);
    if (!equations.assemble(state) || !equations.solve()) continue;
    bool fits = true;
    for (const int i : list) {
      const auto contact = static_cast<std::size_t>(i);
      fits = fits &&
             (state.contacts[contact].closed ? equations.contact_force(contact) >= -force_allowance
                                             : equations.gap_acceleration(contact) >= -1e-6);
    }
    if (fits) return true;
  }
  return false;
}

}  // namespace

std::optional<double> change_contacts(NetworkEquations& equations,
                                      NetworkState& state,
                                      const std::vector<int>& struck,
                                      const std::vector<int>& released,
                                      const IntegrationOptions& options,
                                      std::vector<ContactEvent>& events) {
  const double at_rest = 1e-6 / 30 * equations.network().length;  // [mm/s]
  std::vector<bool> was_closed;
  for (const MovingContact& contact : state.contacts) was_closed.push_back(contact.closed);
  equations.assemble(state);
  equations.solve();
  const double energy_before = equations.energies().kinetic;
  std::vector<int> list = touching(equations.network(), equations, state, struck);
  if (list.size() > kMostTouching) return std::nullopt;
  std::vector<double> before(state.contacts.size());
  for (std::size_t i = 0; i < before.size(); ++i) before[i] = equations.gap_rate(i);
  const bool impact =
      std::any_of(list.begin(), list.end(), [&](int i) { return before[i] < -at_rest; });
  if (impact) {
    for (const unsigned subset : subsets(list.size())) {
      close_only(state, list, subset);
      if (strike(equations, state, list, before, options)) break;
    }
    rest_slow_ones(equations, state, list, options.least_rebound);
  }
  equations.assemble(state);
  std::vector<int> resting;
  for (const int i : list) {
    state.contacts[i].closed = false;
    const bool leaves = equations.gap_rate(static_cast<std::size_t>(i)) > at_rest;
    if (!leaves && !holds(released, i)) resting.push_back(i);
  }
  if (!choose_closed(equations, state, resting, 0)) close_only(state, resting, ~0U);
  equations.assemble(state);
  equations.solve();
  for (std::size_t i = 0; i < before.size(); ++i) {
    const int contact = static_cast<int>(i);
    const bool hit = holds(list, contact) && before[i] < -at_rest;
    if (hit || was_closed[i] != state.contacts[i].closed)
      events.push_back({state.t, contact, hit || state.contacts[i].closed, hit ? -before[i] : 0});
  }
  return energy_before - equations.energies().kinetic;
}

}  // namespace condyle
