#include "condyle/math/rotation.h"

#include <Eigen/Geometry>

#include <cmath>

namespace condyle {

Eigen::Matrix3d skew(const Eigen::Vector3d& v) {
  Eigen::Matrix3d S;
  // clang-format off
  S <<     0, -v.z(),  v.y(),
       v.z(),      0, -v.x(),
      -v.y(),  v.x(),      0;
  // clang-format on
  return S;
}

Eigen::Matrix3d exp_rotation(const Eigen::Vector3d& theta) {
  // exp [θ]x = I + a [θ]x + b (θθᵀ - θ²I),  a = sin θ / θ,  b = (1 - cos θ) / θ² = 2 sin²(θ/2) / θ²
  const double square = theta.squaredNorm();
  double a, b;
  if (square < 0.06) {  // the next terms are below 1e-17
    const double s = square;
    a = 1 - s / 6 * (1 - s / 20 * (1 - s / 42 * (1 - s / 72 * (1 - s / 110))));
    b = 0.5 - s / 24 * (1 - s / 30 * (1 - s / 56 * (1 - s / 90 * (1 - s / 132))));
  } else {
    const double angle = std::sqrt(square);
    const double half = std::sin(angle / 2);
    a = std::sin(angle) / angle;
    b = 2 * half * half / square;
  }
  Eigen::Matrix3d R = b * theta * theta.transpose() + a * skew(theta);
  R.diagonal().array() += 1 - b * square;
  return R;
}

Eigen::Vector3d log_rotation(const Eigen::Matrix3d& R) {
  // Through the unit quaternion: its vector part is θ/|θ| sin(|θ|/2), well conditioned for every
  // angle.
  Eigen::Quaterniond q(R);
  q.normalize();
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  const double s = q.vec().norm();
  if (s < 1e-8) return 2 * q.vec();  // the next term is s³/3
  return 2 * std::atan2(s, q.w()) / s * q.vec();
}

Eigen::Vector3d cayley_vector(const Eigen::Matrix3d& R) {
  const Eigen::Vector3d twice_sine(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
  return 2 / (1 + R.trace()) * twice_sine;
}

Eigen::Matrix3d cayley_rotation(const Eigen::Vector3d& c) {
  const Eigen::Vector3d g = c / 2;
  const double b = 2 / (1 + g.squaredNorm());
  Eigen::Matrix3d R = b * g * g.transpose() + b * skew(g);
  R.diagonal().array() += b - 1;
  return R;
}

Eigen::Matrix3d orthonormalized(const Eigen::Matrix3d& R) {
  return Eigen::Quaterniond(R).normalized().toRotationMatrix();
}

}  // namespace condyle
