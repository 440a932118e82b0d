#pragma once

/// Curvature tensors K [1/mm] with K n = 0 (surface.h), compared and bounded.

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace condyle {

[[nodiscard]] inline Eigen::Vector3d off_normal(const Eigen::Vector3d& v,
                                                const Eigen::Vector3d& n) {
  return v - v.dot(n) * n;
}

/// The greatest principal value off the normal, from trace and squared norm.
[[nodiscard]] inline double largest_principal(double trace, double square) {
  return 0.5 * (trace + std::sqrt(std::max(0.0, 2 * square - trace * trace)));
}

[[nodiscard]] inline double largest_principal(const Eigen::Matrix3d& K) {
  return largest_principal(K.trace(), K.squaredNorm());
}

/// By how much two tensors differ in the tangent plane with the normal n: one that merely turns
/// with its normal is no change.
[[nodiscard]] inline double tangent_change(const Eigen::Matrix3d& K,
                                           const Eigen::Matrix3d& from,
                                           const Eigen::Vector3d& n) {
  const Eigen::Matrix3d D = K - from;
  const Eigen::Vector3d Dn = D * n;
  const double along = n.dot(Dn);
  return std::sqrt(std::max(0.0, D.squaredNorm() - 2 * Dn.squaredNorm() + along * along));
}

}  // namespace condyle
