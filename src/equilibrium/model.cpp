#include "equilibrium/model.h"

#include <algorithm>

namespace condyle {

double condition_weight(const Model& model, std::size_t condition) {
  return is_angle(model.conditions[condition].kind) ? model.length : 1;
}

double edge_distance(const ContactPair& pair, const Place& on_B, const Place& on_A) {
  return std::min(pair.on_B->edge_distance(on_B), pair.on_A->edge_distance(on_A));
}

}  // namespace condyle
