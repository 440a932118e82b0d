#pragma once

/// Where two bones face each other, from nothing but their shape: without unit, side or orientation.

#include "condyle/mesh/triangle_mesh.h"

namespace condyle {

/// Area-weighted middle of a surface and its extents along its principal directions.
struct SurfaceExtents {
  Eigen::Vector3d middle;
  Eigen::Matrix3d axes;   ///< columns, that of the largest variance first
  Eigen::Vector3d sizes;  ///< along some principal direction each, the longest first
};
[[nodiscard]] SurfaceExtents surface_extents(const TriangleMesh& mesh);

/// The faces of the tibia nearest to the femur, as a flat piece of surface.
struct KneeEnds {
  Eigen::Vector3d joint;                    ///< middle of what faces the femur
  Eigen::Vector3d proximal;                 ///< unit, across it, from the tibia towards the femur
  Eigen::Vector3d across;                   ///< unit, along its longest extent: lateral or medial
  double femur_width = 0, tibia_width = 0;  ///< of the ends there, along `across`
  double gap = 0;                           ///< between the surfaces where they are nearest
};

/// In the unit of the meshes.
[[nodiscard]] KneeEnds find_knee_ends(const TriangleMesh& femur, const TriangleMesh& tibia);

/// Triangles with all corners within `radius` of `middle`.
[[nodiscard]] TriangleMesh crop_ball(const TriangleMesh& mesh,
                                     const Eigen::Vector3d& middle,
                                     double radius);

}  // namespace condyle
