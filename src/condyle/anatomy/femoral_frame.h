#pragma once

/// Anatomical frame of a femur from its shape.

#include <vector>

#include "condyle/anatomy/knee_ends.h"
#include "condyle/anatomy/posterior_cylinder.h"
#include "condyle/mesh/clean_mesh.h"
#include "condyle/surface/condylar_axis.h"

namespace condyle {

struct FemoralShape {
  BoneFrame frame;  ///< as of a right knee: `lateral` is anterior x proximal
  PosteriorCylinder cylinder;
  CondylarAxis axis;       ///< two radii, for what the sides differ in
  TriangleMesh end;        ///< the articular end, facing outward
  double width = 0;        ///< of the end [mm]
  double shaft = 0;        ///< length of shaft that the frame went by [mm]
  double shaft_first = 0;  ///< where that begins, from the origin [mm]
  double lean = 0;         ///< of the shaft towards `lateral`, going up [rad]; 0 without shaft
};

/// Where the condyles of a femur are, roughly.
struct Condyles {
  CondylarAxis axis;
  BoneFrame frame;  ///< as of a right knee
};

/// Turns open components of `femur` outward. Throws InputError where there are no posterior condyles.
/// Tried in turn are frames that are turned by `turns` against the tibia's longest extent [rad].
[[nodiscard]] Condyles find_condyles(CleanMesh& femur,
                                     const KneeEnds& ends,
                                     const std::vector<double>& turns = {0, 0.25, -0.25});

/// `tibia_proximal`, that of the tibia as scanned, has a say where there is no shaft.
[[nodiscard]] FemoralShape find_femoral_frame(const TriangleMesh& femur,
                                              const Condyles& condyles,
                                              const KneeEnds& ends,
                                              const Eigen::Vector3d& tibia_proximal);

}  // namespace condyle
