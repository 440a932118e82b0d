#pragma once

/// The two sides of a contact with layers, what presses on them, and their force on a grid that has nothing to do with
/// the solver's.

#include <array>
#include <optional>

#include "condyle/verify/layer_series.h"

namespace condyle::verification {

/// Forces less than that need not be known to their per cent [N].
inline constexpr double kLightForce = 5;

/// One surface of a contact with the points of it, pressed into the other.
struct LayerPoints {
  const SurfaceSide &own, &other;
  bool on_A;
  RigidTransform to_other;  ///< from the frame of the body that carries the points
};

[[nodiscard]] std::array<LayerPoints, 2> sides_of(const PairOfSides& pair, const RigidTransform& X);

/// Of the sides that have points, each carries its part.
[[nodiscard]] double share_of_a_side(const PairOfSides& pair);

struct LayerResultant {
  Vector3d force = Vector3d::Zero(), moment = Vector3d::Zero();  ///< on A, about O_A, ground frame
  double sum = 0, deepest = 0;
  int points = 0;  ///< that are pressed
  void press(const LayerPoints& side,
             const RigidTransform& X,
             const Vector3d& point,
             const ClosestPoint& closest,
             double force_here);
};

/// On cells that are halved until the forces of two grids in a row agree; nothing where they do not within what can be
/// looked at.
[[nodiscard]] std::optional<LayerResultant> resultant_on_grid(const PairOfSides& pair,
                                                              const RigidTransform& X,
                                                              const LayersInSeries& law);

}  // namespace condyle::verification
