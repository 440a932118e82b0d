#pragma once

/// How far from a sample of a surface, along its normal, the surface is nearest there: the radius of the largest
/// ball that touches the surface at the sample and holds no other one (medial ball). A point
/// closer than that has its closest point there, and not on another sheet of the surface, or beyond the centre of
/// its curvature. Measured by shrinking balls [Ma 2012], when a sample is first asked for; it belongs
/// to one thread.

#include <array>
#include <vector>

#include "condyle/contact/surface_cover.h"

namespace condyle {

class MedialReach {
 public:
  explicit MedialReach(const SurfaceCover& cover);

  /// Of a point `along` [mm] over a sample's tangent plane, near its normal: is the surface nearest at the sample,
  /// as far as samples tell? Adds to `looked_at` what measuring takes the first time after each reset, so that the
  /// sum does not tell what was asked before.
  [[nodiscard]] bool holds(int sample, double along, long& looked_at);

  void reset() { ++now_; }

 private:
  struct Reach {
    double radius = -1;  ///< [mm]; below zero: not measured
    long looked_at = 0;  ///< what measuring took
    int counted = -1;    ///< after which reset
  };

  /// On the side that the normal points to (1), or on the other (-1).
  [[nodiscard]] Reach measure(int sample, double side) const;

  const SurfaceCover* cover_;
  std::array<std::vector<Reach>, 2> reach_;  ///< over and under each sample
  int now_ = 0;
};

}  // namespace condyle
