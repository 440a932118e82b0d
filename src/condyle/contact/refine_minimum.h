#pragma once

/// From two places to the minimum of the gap near them.

#include "condyle/contact/contact_places.h"
#include "condyle/math/rigid_transform.h"

namespace condyle {

/// Refines two places to a local minimum of the gap at a fixed pose: Newton on g tangential = 0, h
/// = 0. False where it does not settle on an isolated minimum within `reach` [mm] of the start.
bool refine_minimum(const SurfacePair& surfaces,
                    ContactPlaces& places,
                    const RigidTransform& X_BA,
                    double reach);

enum class Refinement {
  kSettled,  ///< on an isolated minimum
  kAbove,    ///< on the way to one above the cutoff
  kLost      ///< none within reach
};

/// The same, but given up where the gap does not fall below `cutoff` [mm] any more.
Refinement refine_minimum_below(double cutoff,
                                const SurfacePair& surfaces,
                                ContactPlaces& places,
                                const RigidTransform& X_BA,
                                double reach);

}  // namespace condyle
