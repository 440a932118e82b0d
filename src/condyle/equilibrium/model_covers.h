#pragma once

/// What the contact searches of a model share.

#include <vector>

#include "condyle/contact/contact_search.h"
#include "condyle/equilibrium/model.h"
#include "condyle/equilibrium/model_covers.h"

namespace condyle {

/// One for each pair, its samples 0.04 L apart (contact_scales.h).
[[nodiscard]] ContactCovers cover_pairs(const Model& model);

/// One search for each pair of the model. `covers` as from cover_pairs(model); throws
/// std::invalid_argument for those of other surfaces.
[[nodiscard]] std::vector<ContactSearch> make_searches(const Model& model,
                                                       const ContactCovers& covers);

}  // namespace condyle
