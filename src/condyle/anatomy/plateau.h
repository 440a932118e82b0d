#pragma once

/// The plateau of a tibia as one plane and an oblong outline.

#include "condyle/mesh/triangle_mesh.h"

namespace condyle {

struct Plateau {
  Eigen::Vector3d middle;  ///< of both halves' middles, on the plane [mm]
  Eigen::Vector3d normal;  ///< unit, of the plane, proximal
  Eigen::Vector3d across;  ///< unit, in the plane, along the longest extent
  Eigen::Vector3d halves;  ///< unit, from the middle of one half to that of the other
  double width = 0;        ///< along `across` [mm]
  double depth = 0;        ///< at right angles to it [mm]
  double eminence = 0;     ///< mean height over the plane where the halves meet [mm]
  double area = 0;         ///< of the faces that make it, seen along the normal [mm²]
};

/// From the faces that look along `proximal` near `at`; both and `across` may be wrong by 30 degrees. The mesh
/// faces outward [mm].
[[nodiscard]] Plateau fit_plateau(const TriangleMesh& mesh,
                                  const std::vector<Eigen::Vector3d>& normals,
                                  const Eigen::Vector3d& at,
                                  const Eigen::Vector3d& proximal,
                                  const Eigen::Vector3d& across);

}  // namespace condyle
