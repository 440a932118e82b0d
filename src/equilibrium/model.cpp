#include "equilibrium/model.h"

#include <algorithm>
#include <cmath>

namespace condyle {

double condition_weight(const Model& model, std::size_t condition) {
  return is_angle(model.conditions[condition].kind) ? model.length : 1;
}

double edge_distance(const ContactPair& pair, const Place& on_B, const Place& on_A) {
  return std::min(pair.on_B->edge_distance(on_B), pair.on_A->edge_distance(on_A));
}

double characteristic_length(const Model& model) {
  double sum = 0;
  int count = 0;
  for (const LineElement& element : model.elements) sum += element.s_D.squaredNorm(), ++count;
  for (const Load& load : model.loads)
    if (!load.moment && !load.custom) sum += load.at.squaredNorm(), ++count;
  const Eigen::Vector3d start = model.start.p;
  for (const ContactPair& pair : model.pairs) {
    const Place place = pair.on_A->seed(model.start.inverse() * start);
    sum += pair.on_A->evaluate(place).c.squaredNorm(), ++count;
  }
  for (const KinematicCondition& condition : model.conditions)
    if (condition.kind == ConditionKind::kDistance) sum += condition.s_D.squaredNorm(), ++count;
  return count == 0 || sum == 0 ? 1 : std::max(std::sqrt(sum / count), 1e-6);
}

}  // namespace condyle
