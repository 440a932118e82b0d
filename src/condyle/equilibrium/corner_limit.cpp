#include "condyle/equilibrium/corner_limit.h"

#include <cmath>
#include <optional>

namespace condyle {
namespace {

/// How far the point of a contact lies from the nearest one of its pair in another state [mm].
double distance_to_others(const Model& model,
                          const ClosedContact& contact,
                          const EquilibriumState& state) {
  const Surface& on_B = *model.pairs[static_cast<std::size_t>(contact.pair)].on_B;
  const Eigen::Vector3d point = on_B.evaluate(contact.places.on_B).c;
  double nearest = INFINITY;
  for (const ClosedContact& other : state.contacts)
    if (other.pair == contact.pair)
      nearest = std::min(nearest, (on_B.evaluate(other.places.on_B).c - point).norm());
  return nearest;
}

/// The contact that `more` has and `fewer` has not, where that is all that differs.
std::optional<std::size_t> additional(const Model& model,
                                      const EquilibriumState& more,
                                      const EquilibriumState& fewer) {
  if (more.contacts.size() != fewer.contacts.size() + 1) return std::nullopt;
  std::vector<int> surplus(model.pairs.size(), 0);
  for (const ClosedContact& contact : more.contacts)
    ++surplus[static_cast<std::size_t>(contact.pair)];
  for (const ClosedContact& contact : fewer.contacts)
    --surplus[static_cast<std::size_t>(contact.pair)];
  std::optional<std::size_t> found;
  double farthest = -1;
  for (std::size_t k = 0; k < more.contacts.size(); ++k) {
    const int pair = surplus[static_cast<std::size_t>(more.contacts[k].pair)];
    if (pair < 0 || pair > 1) return std::nullopt;
    if (pair == 0) continue;
    const double distance = distance_to_others(model, more.contacts[k], fewer);
    if (distance > farthest) found = k;
    farthest = std::max(farthest, distance);
  }
  return found;
}

}  // namespace

bool turns_back(PathSystem& path,
                const Model& model,
                const SolvedPose& before,
                const SolvedPose& after) {
  const auto opened = additional(model, before.state, after.state);
  const auto closed = additional(model, after.state, before.state);
  const PathPoint from{before.state, before.value}, to{after.state, after.value};
  PathSystem::Direction tangent;
  if (!(opened || closed) || !path.tangent(to, tangent)) return false;
  double rate = closed ? tangent.force(*closed) : 0;
  if (opened) {
    if (!path.assemble(from)) return false;
    rate = path.gap_rate(path.linearization(from).contacts()[*opened], tangent);
  }
  return rate * tangent.value() * (after.value - before.value) < 0;
}

}  // namespace condyle
