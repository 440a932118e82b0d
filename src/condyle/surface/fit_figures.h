#pragma once

/// How well a patch follows the region it was fitted to.

#include <array>

#include "condyle/surface/articular_region.h"
#include "condyle/surface/fit_patch.h"

namespace condyle {

/// Distances in mm, root mean squares by area. Core: farther than `core_margin` from the edge of
/// the data.
struct FitFigures {
  double rms = 0, p95 = 0, max = 0;
  double core_rms = 0, core_max = 0;
  int core_farthest = -1;                          ///< the vertex of core_max
  double core_normal_rms = 0;                      ///< angle between patch and mesh normals [rad]
  std::array<double, 2> curvature_range = {0, 0};  ///< principal curvatures in the core [1/mm]
  double back_rms = 0, back_p95 = 0,
         back_max = 0;                    ///< from the patch, where it is known, to the mesh
  std::array<double, 2> extent = {0, 0};  ///< of the known part along u and v, at its longest [mm]
  std::array<double, 2> turn = {0, 0};    ///< of the normal along them, at its greatest [rad]
  double area = 0;                        ///< of the known part [mm²]
  double depth = 0;                       ///< greatest distance from its edge [mm]
  int folded = 0;                         ///< vertices where the patch faces away from the mesh
};
[[nodiscard]] FitFigures measure_fit(const ArticularRegion& region,
                                     const PatchFit& fit,
                                     double core_margin = 4);

/// The two principal curvatures of a surface point, the smaller first [1/mm].
[[nodiscard]] std::array<double, 2> principal_curvatures(const SurfacePoint& at);

}  // namespace condyle
