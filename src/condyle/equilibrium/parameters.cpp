#include "condyle/equilibrium/parameters.h"

#include <fmt/format.h>

#include <stdexcept>

namespace condyle {

Parameters parameters_of(const Model& model) { return {model.elements, model.loads}; }

void check_parameters(const Parameters& parameters, const Model& model) {
  if (parameters.elements.size() == model.elements.size() &&
      parameters.loads.size() == model.loads.size())
    return;
  throw std::invalid_argument(fmt::format(
      "the parameters are of {} line elements and {} loads, expected {} and {} as the model has",
      parameters.elements.size(), parameters.loads.size(), model.elements.size(),
      model.loads.size()));
}

}  // namespace condyle
