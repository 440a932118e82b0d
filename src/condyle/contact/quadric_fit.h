#pragma once

/// A quadric through a piece of surface, and how far the surface may rise over it.
///
/// Where a surface is rough its osculating quadric says little beyond a wave: curvatures of 0.04
/// per mm in waves of 5 mm are heights of 0.025 mm. A quadric with the mean curvature of a piece
/// departs from it by such heights alone.

#include <span>

#include "condyle/surface/surface.h"

namespace condyle {

/// A piece of surface about a point.
struct SurfaceCell {
  SurfacePoint at;    ///< c, n and K of its quadric
  double radius = 0;  ///< [mm]
  double rise = 0;    ///< of the surface over the quadric, greatest [mm]
};

using SurfaceCells = std::span<const SurfaceCell* const>;

/// The mean curvature tensor of the cells near `about`, the normal that leaves no mean slope and the
/// height that leaves no mean height; each cell counts by its area.
[[nodiscard]] SurfacePoint mean_quadric(const SurfacePoint& about, SurfaceCells cells);

/// The mean quadric, or the one at `about` where the cells rise less over that; `radius` holds all
/// of them and `rise` is that of all of them, infinite where the surface turns by more than 60
/// degrees.
[[nodiscard]] SurfaceCell fit_quadric(const SurfacePoint& about, SurfaceCells cells);

}  // namespace condyle
