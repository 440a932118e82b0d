#pragma once

/// What a contact law without unknowns (contact_law.h) knows of its own at a pose beside its wrench
/// and the derivatives of that: how the place of its resultant moves, and what a stiffer layer does.

#include <array>

#include "condyle/elements/wrench.h"
#include "condyle/math/rigid_transform.h"

namespace condyle {

struct ContactRates {
  using Matrix36 = Eigen::Matrix<double, 3, 6>;
  /// By a factor on the modulus of one surface's layer, at a fixed pose.
  struct Stiffer {
    Eigen::Vector3d f = Eigen::Vector3d::Zero();          ///< of the force on A [N]
    Eigen::Vector3d m = Eigen::Vector3d::Zero();          ///< of its moment about O_A [N mm]
    Eigen::Vector3d resultant = Eigen::Vector3d::Zero();  ///< of the resultant's place [mm]
  };
  Matrix36 resultant = Matrix36::Zero();  ///< ∂(ContactResult::resultant_ground)/∂(a, π)
  std::array<Stiffer, 2> stiffer;         ///< of the layers on B and on A; zeros for a rigid side
};

}  // namespace condyle
