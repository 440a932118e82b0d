#pragma once

/// How strongly a bicubic patch bends at most, for certain and not by samples: in each knot cell by
/// the convex hulls of the derivatives' Bézier points. For bounds of how far a signed distance can
/// turn away from its tangent.

#include <limits>
#include <vector>

#include "condyle/surface/patch_cells.h"

namespace condyle {

/// Of the places within some way of one.
struct BendBound {
  double most = std::numeric_limits<double>::infinity();  ///< no curvature is greater [1/mm]
  double way = 0;                                         ///< along the surface [mm]
};

class PatchBends {
 public:
  explicit PatchBends(const PatchCells& cells);

  /// About the place (u, v); a way of 0 where nothing is known: at the edges of the box of
  /// parameters, and where the patch folds or is not bicubic.
  [[nodiscard]] const BendBound& about(double u, double v) const;

 private:
  const PatchCells& cells_;
  std::vector<BendBound> about_;  ///< of the cells, v fastest
  BendBound unknown_;
};

}  // namespace condyle
