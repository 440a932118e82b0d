#include "condyle/network/knee_network.h"

#include <fmt/format.h>

#include "condyle/contact/contact_scales.h"
#include "condyle/contact/contact_search.h"
#include "condyle/input_error.h"

namespace condyle {
namespace {

void add_ligaments(const Model& model, Network& network) {
  for (std::size_t i = 0; i < model.elements.size(); ++i) {
    const LineElement& element = model.elements[i];
    const std::string& name = model.element_names[i];
    LineComponent line;
    line.name = name;
    line.from = add_port(network, name + ": fixed end", kGround, element.x_C);
    line.to = add_port(network, name + ": moving end", 0, element.s_D);
    line.law = element.law;
    line.path = element.path;
    network.lines.push_back(line);
  }
}

constexpr double kReach = 5.0 / 3;  // of L: how far an open pair is looked for

/// The first contact of the pair that is not taken yet.
void close_next(const Model& model,
                const KneeNetwork& knee,
                const ClosedContact& contact,
                NetworkState& state) {
  for (std::size_t i = 0; i < knee.places.size(); ++i) {
    if (knee.places[i] != contact.pair || state.contacts[i].closed) continue;
    state.contacts[i] = {contact.places, true};
    return;
  }
  throw InputError(
      fmt::format("contact \"{}\" touches in more points at the start than a motion "
                  "follows, expected at most {}",
                  model.pairs[contact.pair].name, kPointsPerPair));
}

}  // namespace

KneeNetwork make_knee_network(const Model& model, const std::optional<MassProperties>& mass) {
  KneeNetwork knee;
  Network& network = knee.network;
  network.length = model.length;
  network.bodies = {{"moving bone", mass, mass ? mass->center : Eigen::Vector3d(0, 0, 0), false}};
  add_ligaments(model, network);
  for (std::size_t i = 0; i < model.loads.size(); ++i)
    network.forces.push_back({model.load_names[i], 0, model.loads[i], {}});
  for (std::size_t i = 0; i < model.pairs.size(); ++i) {
    const ContactPair& pair = model.pairs[i];
    if (pair.law) {
      network.potentials.push_back({pair.name, 0, pair.law(pair)});
      knee.potentials.push_back(static_cast<int>(i));
    }
    if (pair.mode == ContactMode::kOpen) continue;
    for (int point = 0; point < kPointsPerPair; ++point) {
      // Of a pair that is held closed the first point stays.
      const bool opens = pair.mode == ContactMode::kAuto || point > 0;
      network.contacts.push_back({pair.name, 0, pair.on_B, pair.on_A, opens, opens});
      knee.places.push_back(static_cast<int>(i));
    }
  }
  for (std::size_t i = 0; i < model.conditions.size(); ++i)
    network.conditions.push_back({model.condition_names[i], 0, model.conditions[i], {}});
  return knee;
}

NetworkState state_at_rest(const Model& model,
                           const ContactCovers& covers,
                           const KneeNetwork& knee,
                           const EquilibriumState& equilibrium) {
  NetworkState state;
  state.bodies = {{equilibrium.X, {0, 0, 0}, {0, 0, 0}}};
  state.contacts.resize(knee.places.size());
  for (const ClosedContact& contact : equilibrium.contacts) close_next(model, knee, contact, state);
  for (std::size_t i = 0; i < knee.places.size(); ++i) {
    MovingContact& contact = state.contacts[i];
    if (contact.closed) continue;
    if (i > 0 && knee.places[i - 1] == knee.places[i]) {
      contact.followed = false;
      continue;
    }
    const ContactPair& pair = model.pairs[knee.places[i]];
    const double L = model.length;
    std::vector<GapMinimum> minima;
    ContactSearch(covers[static_cast<std::size_t>(knee.places[i])])
        .find_nearest(equilibrium.X, kReach * L, minima);
    if (!minima.empty())
      contact = {minima.front().places};
    else
      contact.places.on_B = pair.on_B->seed(equilibrium.X.p);
  }
  return state;
}

}  // namespace condyle
