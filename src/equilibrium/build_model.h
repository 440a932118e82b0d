#pragma once

/// The only place that turns a described scene into a Model.

#include <vector>

#include "equilibrium/model.h"
#include "scene/fit_surfaces.h"
#include "scene/scene.h"

namespace condyle {

/// `surfaces` as from fit_surfaces: one per Scene::surfaces. The origins of the model's frames are
/// the middles of the contact surfaces of either body (model_origins.h).
[[nodiscard]] Model build_model(const Scene& scene, const std::vector<FittedSurface>& surfaces);

}  // namespace condyle
