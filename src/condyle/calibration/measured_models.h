#pragma once

/// The models behind a table of measurements: a condition that a displacement-controlled test holds is
/// absent from all other tests, so each such condition has a model of its own. They share everything
/// else, surfaces and samples of contact searches included.

#include <memory>
#include <vector>

#include "condyle/equilibrium/build_model.h"
#include "condyle/equilibrium/model_covers.h"

namespace condyle {

struct MeasuredModel {
  std::shared_ptr<const Model> model;
  int held = -1;                ///< of Scene::conditions: which is held in its tests; -1: none
  std::vector<int> conditions;  ///< by Scene::conditions: which of the model's, -1: absent
};

struct MeasuredModels {
  std::vector<MeasuredModel> models;  ///< the first holds no condition of a test
  ContactCovers covers;               ///< of all of them

  /// The model in which that condition of the scene is held; the first for -1.
  [[nodiscard]] std::size_t that_holds(int condition) const;
};

/// Needs scene.calibration; `surfaces` as from fit_surfaces.
[[nodiscard]] MeasuredModels measured_models(const Scene& scene,
                                             const std::vector<FittedSurface>& surfaces);

}  // namespace condyle
