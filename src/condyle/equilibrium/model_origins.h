#pragma once

/// Which points of the two bodies a model is best computed about.

#include "condyle/equilibrium/model.h"

namespace condyle {

/// On each body the mean of the middles of its contact surfaces, else of its insertions, else on A
/// of the points of loads and on B where that is at the start. In the model's frames as they are.
[[nodiscard]] BodyOrigins middle_of_forces(const Model& model);

/// The same model with these points as the origins of its frames; `Model::origins` grows by them.
/// Loads are none that compute themselves.
void move_origins(const BodyOrigins& to, Model& model);

}  // namespace condyle
