#pragma once

/// Does the known part of a surface end somewhere? Behind such a surface is not yet inside.

#include <cmath>

#include "condyle/surface/surface.h"

namespace condyle {

[[nodiscard]] inline bool has_edge(const Surface& surface) {
  return std::isfinite(surface.edge_distance(surface.seed(Eigen::Vector3d::Zero())));
}

}  // namespace condyle
