#pragma once

/// Stiffness and compliance of the joint at a position of equilibrium, in joint coordinates.
///
/// An added load Q has the components (flexion, adduction, internal rotation [N mm]; lateral shift,
/// anterior drawer, distraction [N]) and does the work Q.dq on the body that moves relative to the
/// other. With J = ∂q/∂(a, π), K = -∂wrench/∂(a, π) and the directions G of what constrains:
///     stiffness   S = J⁻ᵀ K J⁻¹            contact forces and multipliers held, their points rolling
///     compliance  C = J Z (Zᵀ K Z)⁻¹ Zᵀ Jᵀ  contacts kept closed, conditions kept (Zᵀ G = 0)
/// S is exact because the wrench vanishes at equilibrium; it is symmetric but for follower loads.
/// Rows and columns of angles are per rad: N mm/rad, N/rad = N mm/(rad mm), N/mm; C has the inverse
/// units.
///
/// Only the model's rigid contact points and conditions constrain: C vanishes where they leave no
/// motion. Contact laws without unknowns are in K.

#include <optional>

#include "condyle/equilibrium/linearization.h"
#include "condyle/equilibrium/pose_result.h"

namespace condyle {

/// At a position of equilibrium. Nothing where the model has no joint, where the coordinates are
/// none (adduction of 90°), or where nothing resists some motion.
[[nodiscard]] std::optional<JointStiffness> joint_stiffness(const Linearization& at);

/// J: how the six joint coordinates change with (da, dπ) [-, 1/mm, mm].
[[nodiscard]] Eigen::Matrix<double, 6, 6> joint_jacobian(const JointFrames& frames,
                                                         const RigidTransform& X_BA);

}  // namespace condyle
