#pragma once

/// Ligaments that run straight through bone: where a wrap is missing.

#include <string>
#include <vector>

#include "condyle/mesh/triangle_mesh.h"
#include "condyle/scene/scene.h"

namespace condyle {

struct StrandInBone {
  int ligament = -1, body = -1;
  double flexion = 0;  ///< of the preset pose where it lies deepest [rad]
  double depth = 0;    ///< there, in the bone [mm]
};

/// Ligaments whose straight line lies deeper by `limit` [mm] in the mesh of one of their bodies than
/// their insertion there, and which do not wrap on it, at a preset pose (preset_flexion.h) in which the far end is outside it.
/// `bones`: the mesh of each body, whose largest part counts. Of one that is open, or of a file that holds both bones, nothing
/// is told; where a ligament might run through it, its body is added to `untold`.
[[nodiscard]] std::vector<StrandInBone> strands_in_bone(const Scene& scene,
                                                        const std::vector<TriangleMesh>& bones,
                                                        double limit = 1,
                                                        std::vector<std::size_t>* untold = nullptr);

/// One line for each fitted wrap whose strings differ much from those over the mesh, one for each
/// bone, and one for each insertion that lies deeper than `limit` [mm] in a wrap of
/// its own body and is moved to its surface. Bones of which strands cannot be told have a line without "warning: ".
[[nodiscard]] std::vector<std::string> wrap_warnings(const Scene& scene,
                                                     const std::vector<TriangleMesh>& bones,
                                                     double limit = 1);

}  // namespace condyle
