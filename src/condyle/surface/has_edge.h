#pragma once

/// Does the known part of a surface end somewhere? Behind such a surface is not yet inside.

#include <cmath>

#include "condyle/surface/exact_charts.h"
#include "condyle/surface/surface.h"

namespace condyle {

[[nodiscard]] inline bool has_edge(const Surface& surface) {
  return std::isfinite(surface.edge_distance(surface.seed(Eigen::Vector3d::Zero())));
}

/// Is what lies behind each known place solid, however deep? So it is of closed surfaces and of exact ones; behind a patch
/// a bone may end.
[[nodiscard]] inline bool bounds_whole_solid(const Surface& surface) {
  return !has_edge(surface) || dynamic_cast<const ExactSurface*>(&surface);
}

}  // namespace condyle
