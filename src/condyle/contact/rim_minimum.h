#pragma once

/// Where the gap is lowest along the edge of the known part of a surface. There it may end within
/// the other surface without any minimum of its own: samples stand a spacing apart, and the edge
/// between them lies deeper than they do.

#include <optional>

#include "condyle/math/rigid_transform.h"
#include "condyle/surface/surface.h"

namespace condyle {

struct RimMinimum {
  Place on_rim, facing;  ///< on the edge, and the closest place of the other surface
  double gap = 0;        ///< [mm]
};

/// Within `reach` [mm] of the place `start` near an edge of `rim`; `facing_start` is a place near
/// the closest one, X takes the frame of `rim` to that of `facing`. Nothing where no edge is found,
/// or where it faces nothing known, or where coarse steps along it show a gap above the cutoff [mm]
/// all the way. To 1e-4 of the reach along the edge, which is of second order in the gap.
[[nodiscard]] std::optional<RimMinimum> rim_minimum(const Surface& rim,
                                                    const Place& start,
                                                    const Surface& facing,
                                                    const Place& facing_start,
                                                    const RigidTransform& X,
                                                    double reach,
                                                    double cutoff);

}  // namespace condyle
