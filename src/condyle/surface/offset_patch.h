#pragma once

/// A patch moved along its normal, out of the bone: the surface of cartilage of even thickness on a
/// bone of which only the mesh is known.
///
/// The offset surface c + d n of a spline is no spline: one of the same degree with knots half as
/// far apart is laid through a dense grid of its points at fixed parameters. Beyond the least
/// radius of the hollows of a surface its offset folds over (a cusp), which is refused.

#include <limits>

#include "condyle/surface/fit_patch.h"
#include "condyle/surface/patch.h"

namespace condyle {

struct OffsetPatch {
  PatchData patch;          ///< with the mask of the moved region
  TriangleMesh region;      ///< the mesh of the region, each vertex moved as the patch below it
  double rms = 0, max = 0;  ///< distance of the patch from the offset surface, where known [mm]
};

/// Where the known part of a patch is hollow with the least radius [mm]: an offset has to be less.
struct Hollow {
  double radius = std::numeric_limits<double>::infinity();
  Eigen::Vector3d at = Eigen::Vector3d::Zero();
};
[[nodiscard]] Hollow sharpest_hollow(const Patch& patch);

/// `offset` > 0 [mm]. Throws InputError (without the name of the surface) where it reaches the
/// least radius of curvature of a hollow of the known part.
[[nodiscard]] OffsetPatch offset_patch(const ArticularRegion& region,
                                       const PatchFit& fit,
                                       double offset);

}  // namespace condyle
