#pragma once

/// Anatomical frame of a tibia from its shape.

#include <string>

#include "condyle/anatomy/knee_ends.h"
#include "condyle/anatomy/plateau.h"
#include "condyle/mesh/clean_mesh.h"
#include "condyle/surface/condylar_axis.h"

namespace condyle {

struct TibialShape {
  BoneFrame
      frame;  ///< as of a right knee: `lateral` is anterior x proximal; origin in the middle of the plateau
  Plateau plateau;
  double shaft = 0;        ///< length of shaft that the frame went by [mm]
  double shaft_first = 0;  ///< where that begins, from the origin [mm]
  double slope = 0;        ///< of the plateau, falling backwards [rad]
};

/// Turns open components of `tibia` upward. `anterior` may be wrong by 60 degrees.
[[nodiscard]] TibialShape find_tibial_frame(CleanMesh& tibia,
                                            const KneeEnds& ends,
                                            const Eigen::Vector3d& anterior);

}  // namespace condyle
