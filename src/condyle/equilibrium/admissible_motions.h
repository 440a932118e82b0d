#pragma once

/// What contacts and conditions prevent, and the motions that they leave.

#include <Eigen/Core>

#include "condyle/equilibrium/linearization.h"

namespace condyle {

/// Motions as columns (da, L dπ); never allocates.
using Motions = Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, 6>;

/// The direction (n, s x n/L) of a closed contact or (α, η/L) of a condition, as a unit vector:
/// contacts come first. What they prevent is a motion along it.
[[nodiscard]] Eigen::Matrix<double, 6, 1> constraint_direction(const Linearization& at,
                                                               std::size_t constraint);

/// An orthonormal basis of the motions that no contact and no condition prevents.
[[nodiscard]] Motions admissible_motions(const Linearization& at);

}  // namespace condyle
