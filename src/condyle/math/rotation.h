#pragma once

/// Rotations as 3 x 3 tensors, perturbed from the left: R <- exp([θ]x) R, θ in the outer (ground)
/// frame [rad]. Exp, never a sum of angles, so no orientation is special
/// (docs/conventions.md).

#include <Eigen/Core>

namespace condyle {

/// [v]x, so that skew(v) * w = v x w.
[[nodiscard]] Eigen::Matrix3d skew(const Eigen::Vector3d& v);

/// exp([θ]x), the rotation by |θ| about θ (Rodrigues); accurate near 0.
[[nodiscard]] Eigen::Matrix3d exp_rotation(const Eigen::Vector3d& theta);

/// The rotation vector θ of R, |θ| <= π; accurate near 0 and near π.
[[nodiscard]] Eigen::Vector3d log_rotation(const Eigen::Matrix3d& R);

/// 2 tan(θ/2) along the axis of R: as smooth in R as the rotation vector and cheaper, for estimates
/// far from half a turn, where it is infinite.
[[nodiscard]] Eigen::Vector3d cayley_vector(const Eigen::Matrix3d& R);

/// The rotation with that vector.
[[nodiscard]] Eigen::Matrix3d cayley_rotation(const Eigen::Vector3d& c);

/// The rotation nearest to R: removes the round-off that many products leave behind.
[[nodiscard]] Eigen::Matrix3d orthonormalized(const Eigen::Matrix3d& R);

}  // namespace condyle
