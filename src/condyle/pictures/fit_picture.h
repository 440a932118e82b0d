#pragma once

/// Pages that show how the patches lie on their meshes and how they bend: the known part of a patch
/// in colours, with a colour bar and a scale bar. A patch that turns far is seen from two sides.

#include <string>
#include <vector>

#include "condyle/pictures/image.h"
#include "condyle/scene/fitted_surface.h"
#include "condyle/scene/scene.h"

namespace condyle {

struct FitPicture {
  std::string name;  ///< "medial_condyle_deviation"
  Image image;
};

/// Deviation and curvature of every patch that was fitted, in the order of the scene. `surfaces` as
/// fit_surfaces gives them. Throws PictureError when the machine cannot draw.
[[nodiscard]] std::vector<FitPicture> draw_fit(const Scene& scene,
                                               const std::vector<FittedSurface>& surfaces);

}  // namespace condyle
