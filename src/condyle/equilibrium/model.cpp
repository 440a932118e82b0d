#include "condyle/equilibrium/model.h"

#include <algorithm>

namespace condyle {

double condition_weight(const Model& model, std::size_t condition) {
  return is_angle(model.conditions[condition].kind) ? model.length : 1;
}

}  // namespace condyle
