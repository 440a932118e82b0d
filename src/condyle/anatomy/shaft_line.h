#pragma once

/// The direction of a shaft over a stretch near the joint, the same whether the bone is whole or cut beyond it.

#include <optional>

#include "condyle/mesh/triangle_mesh.h"

namespace condyle {

struct ShaftStretch {
  double first = 0, last = 0;  ///< distances from the start [mm]
  double least = 0;            ///< how much of it there must be [mm]
};

struct ShaftLine {
  Eigen::Vector3d direction;  ///< unit, away from the joint
  double length = 0;          ///< of the stretch that it goes by [mm]
};

/// Line through the centroids of sections across `along` (unit, away from the joint), those at `first`
/// to `last` from `start`. The shaft is the largest outline of a section: a fibula is another one. It
/// ends where the outline is open or shrinks at once. None where too little of it is there.
[[nodiscard]] std::optional<ShaftLine> find_shaft_line(const TriangleMesh& mesh,
                                                       const Eigen::Vector3d& start,
                                                       const Eigen::Vector3d& along,
                                                       const ShaftStretch& stretch);

}  // namespace condyle
