#pragma once

/// The only place that turns a described scene into a Model.

#include <vector>

#include "condyle/equilibrium/drive.h"
#include "condyle/scene/fitted_surface.h"
#include "condyle/scene/scene.h"

namespace condyle {

/// `surfaces` as from fit_surfaces: one per Scene::surfaces. The origins of the model's frames are
/// the middles of the contact surfaces of either body (model_origins.h).
[[nodiscard]] Model build_model(const Scene& scene, const std::vector<FittedSurface>& surfaces);

/// Which number of that model's drive a sweep varies.
[[nodiscard]] Swept swept_of(const SweepDescription& sweep);

}  // namespace condyle
