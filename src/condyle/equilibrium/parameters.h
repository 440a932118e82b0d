#pragma once

/// What a study changes from run to run while the model stays: laws, slack lengths and insertions
/// of line elements, and vectors and points of loads. The model's own are the nominal ones; bodies,
/// surfaces, conditions and the length L are its alone.

#include <vector>

#include "condyle/equilibrium/model.h"

namespace condyle {

struct Parameters {
  std::vector<LineElement> elements;  ///< as Model::elements
  std::vector<Load> loads;            ///< as Model::loads; their scales are the drive's
};

[[nodiscard]] Parameters parameters_of(const Model& model);

/// Throws std::invalid_argument with one sentence where there are not as many as the model has.
void check_parameters(const Parameters& parameters, const Model& model);

}  // namespace condyle
