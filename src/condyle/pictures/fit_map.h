#pragma once

/// What can be shown in colours on a patch: its distance from the mesh, its principal curvatures.

#include <functional>
#include <string>

#include "condyle/pictures/shaded_mesh.h"
#include "condyle/scene/fitted_surface.h"
#include "condyle/surface/patch.h"

namespace condyle {

struct FitMap {
  std::string panel;        ///< what the panel says it shows
  std::string title, unit;  ///< of the colour bar
  double limit = 1;         ///< the colours reach from -limit to +limit
  std::function<double(const SurfacePoint&)> value = {};
};

/// From the patch to the mesh of its region [mm], positive where the mesh lies outside. `fitted`
/// must outlive the map and have a report. The colours hold 99 % of the patch.
[[nodiscard]] FitMap deviation_map(const FittedSurface& fitted);

enum class Principal { kGreatest, kLeast };
/// [1/mm], negative where the bone is round like a ball. The colours are the same for both and hold
/// both on 85 % of the patch: rims and eminence, which bend most, do not drown the rest.
[[nodiscard]] FitMap curvature_map(const Patch& patch, Principal which);

/// The known part of the patch in the colours of the map, body frame.
[[nodiscard]] ShadedMesh painted(const Patch& patch, const FitMap& map);

}  // namespace condyle
