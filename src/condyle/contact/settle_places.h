#pragma once

/// Two places of a pair brought to where the gap is stationary at a fixed pose, by Newton's method on
///
///     h = n + m = 0,   g - γ n = 0,   γ = n.g
///
/// (contact.h), each step that of A on the surface parallel to B's at the distance γ. It converges
/// quadratically at any gap. In a direction in which the relative curvature vanishes the places
/// stay where they are: on a line they settle across it.

#include <limits>

#include "condyle/contact/contact.h"

namespace condyle {

struct Settling {
  /// How far the point on B may come from its start, and how long a step may be [mm]. A step
  /// shorter than 1e-8 of this is the last: it squares what is off.
  double reach;
  /// Only an isolated minimum will do, the normals opposite: where the gap bends downwards the step
  /// goes downhill, so that no saddle attracts.
  bool on_minimum = false;
  /// Given up where the gap will not fall below this any more [mm].
  double cutoff = std::numeric_limits<double>::infinity();
};

enum class Settled {
  kThere,
  kAbove,  ///< on the way to a place above the cutoff
  kLost    ///< nothing of that kind within reach
};

/// `at`: the points of the places where it ended, across their gap; of no use where a place is not
/// finite.
Settled settle_places(const SurfacePair& surfaces,
                      const RigidTransform& X_BA,
                      const Settling& how,
                      ContactPlaces& places,
                      ContactLinearization& at);

/// To a minimum by steps that lower it: of the point of one surface, that of A or of B, over the point of the other that
/// is closest to it. For what Newton's steps run away from, as the curvature changes within them. Where it does not
/// settle, as within a blade where two points are closest, the places are the lowest that it came to. `points` grows by
/// what it looks at.
Settled settle_downhill(const SurfacePair& surfaces,
                        const RigidTransform& X_BA,
                        const Settling& how,
                        bool point_of_A,
                        ContactPlaces& places,
                        ContactLinearization& at,
                        long& points);

/// Are the normals opposite, but for round-off? Those of a tilted line are not.
[[nodiscard]] inline bool are_opposite(const ContactLinearization& at) {
  constexpr double kRoundOff = 1e-10;  // sine between them
  return at.h.norm() < kRoundOff;
}

}  // namespace condyle
