#pragma once

#include "condyle/equilibrium/model.h"
#include "condyle/surface/exact_surfaces.h"
#include "support/hold.h"

namespace condyle::test {

/// Two feet of curvature 0.2/mm, at x = -5 and 5 mm of a body that a moment of 12 N mm per 10 N of load tilts.
inline Model on_two_feet(ContactMode mode) {
  Model model;
  ContactPair pair;
  pair.name = "feet";
  pair.mode = mode;
  pair.on_B = make_plane({0, 0, 0}, {0, 0, 1}, 40);
  // z = (x² - 25)²/500 + y²/10, least at the feet; the solid lies above.
  pair.on_A = make_polynomial({0, 0, 0}, Eigen::Matrix3d::Identity(),
                              {{4, 0, 0.002}, {2, 0, -0.1}, {0, 0, 1.25}, {0, 2, 0.1}},
                              /*solid_inside=*/false, 12);
  model.pairs = {pair};
  Load weight;
  weight.vector = {0, 0, -10};
  weight.at = {1.2, 0, 0};
  model.loads = {weight};
  model.load_names = {"weight"};
  hold(model, ConditionKind::kTranslation, 0);
  hold(model, ConditionKind::kTranslation, 1);
  hold(model, ConditionKind::kRotation, 0);
  hold(model, ConditionKind::kRotation, 2);
  model.length = 15;
  return model;
}

}  // namespace condyle::test
