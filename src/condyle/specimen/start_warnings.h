#pragma once

/// What a user should know before a sweep: overlap or gap of the bodies at the start pose, ligament
/// insertions off the bone, slack lengths that hardly fit the start pose, ligaments that run straight
/// through bone, insertions deep in a wrap, surfaces far larger than a knee. A strain that the scene
/// gives itself for the start pose (`reference_strain`) is no surprise.

#include <string>
#include <vector>

#include "condyle/scene/fitted_surface.h"
#include "condyle/scene/scene.h"

namespace condyle {

struct StartLimits {
  double gap = 1;        ///< of a contact, or overlap, where the start pose sets strains [mm]
  double insertion = 3;  ///< from the mesh of the body [mm]
  double strain = 0.15;  ///< of a ligament, either way [-]
  double inside = 1;     ///< of a straight ligament in bone, of an insertion in its own wrap [mm]
};

/// One line each; those beyond the limits begin with "warning: ". `bones`: the mesh of each body of
/// the scene, empty where it has none.
[[nodiscard]] std::vector<std::string> start_warnings(const Scene& scene,
                                                      const std::vector<FittedSurface>& surfaces,
                                                      const std::vector<TriangleMesh>& bones,
                                                      const StartLimits& limits = {});

/// The same with the meshes of the bodies loaded for it.
[[nodiscard]] std::vector<std::string> start_warnings(const Scene& scene,
                                                      const std::vector<FittedSurface>& surfaces,
                                                      const StartLimits& limits = {});

}  // namespace condyle
