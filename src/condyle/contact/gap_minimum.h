#pragma once

/// A place where the gap between two surfaces is smallest at a pose.

#include "condyle/contact/contact.h"

namespace condyle {

/// A local minimum of the gap, or, where the refinement did not settle, the lowest sample.
struct GapMinimum {
  ContactPlaces places;
  double gap = 0;              ///< [mm], < 0 overlap
  Eigen::Vector3d point_B, n;  ///< point and normal on B, ground frame
  bool refined = false;  ///< normals parallel, an isolated minimum (relative curvature positive)
  double edge = 0;       ///< smaller of the two edge distances [mm]
  /// Between both normals, above 0 where the surfaces do not face each other; of places at a rim not told.
  double cosine = -1;
};

/// What is told of two places linearised at a pose; nothing is said of whether they are a minimum.
[[nodiscard]] inline GapMinimum minimum_at(const SurfacePair& surfaces,
                                           const ContactPlaces& places,
                                           const ContactLinearization& at) {
  return {places,          at.gap(), at.B.c, at.B.n, false, edge_distance(surfaces, places),
          at.B.n.dot(at.m)};
}

}  // namespace condyle
