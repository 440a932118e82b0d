#pragma once

/// The pairs of a model on elastic layers of cartilage, for tests.

#include "condyle/contact/layer_contact.h"
#include "condyle/equilibrium/model.h"

namespace condyle::test {

/// k [N/mm³] of two layers of 3 mm with E = 10 N/mm² and ν = 0.45 in series.
inline constexpr double kLayerStiffness = 6.321839080459770;

/// Both surfaces of each pair with a layer of 3 mm, ν = 0.45.
inline Model on_layers(Model model, double modulus = 10, const LayerOptions& options = {}) {
  for (ContactPair& pair : model.pairs) {
    pair.elastic_B = pair.elastic_A = ElasticSurface{modulus, 0.45, 3};
    pair.mode = ContactMode::kOpen;
    pair.law = layer_contact(options);
  }
  return model;
}

}  // namespace condyle::test
