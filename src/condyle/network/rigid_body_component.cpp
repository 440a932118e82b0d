#include "condyle/network/rigid_body_component.h"

#include <Eigen/Geometry>

#include "condyle/math/rotation.h"

namespace condyle {
namespace {

Eigen::Matrix3d turned(const Eigen::Matrix3d& R, const Eigen::Matrix3d& tensor) {
  return R * tensor * R.transpose();
}

Matrix6 inertia_matrix(double m, const Eigen::Vector3d& arm, const Eigen::Matrix3d& J_G) {
  const Eigen::Matrix3d S = skew(arm);
  Matrix6 P;
  P << m * Eigen::Matrix3d::Identity(), m * S.transpose(), m * S, J_G + m * S * S.transpose();
  return P;
}

}  // namespace

Matrix6 carrier(const Eigen::Vector3d& arm) {
  Matrix6 K = Matrix6::Identity();
  K.bottomLeftCorner<3, 3>() = skew(arm);
  return K;
}

Eigen::MatrixXd hybrid_matrix(const std::vector<Eigen::Vector3d>& arms) {
  const auto k = static_cast<Eigen::Index>(arms.size());
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(6 * (k + 1), 6 * (k + 1));
  for (Eigen::Index j = 0; j < k; ++j) {
    const Matrix6 K = carrier(arms[static_cast<std::size_t>(j)]);
    H.block<6, 6>(6 * j, 6 * k) = K.transpose();
    H.block<6, 6>(6 * k, 6 * j) = -K;
  }
  return H;
}

InertiaTerms inertia_terms(const MassProperties& mass,
                           const Eigen::Vector3d& reference,
                           const Eigen::Matrix3d& R,
                           const Vector6& x_0,
                           const Eigen::Vector3d& gravity) {
  const Eigen::Vector3d omega = x_0.tail<3>();
  const double m = mass.mass;
  InertiaTerms terms;
  terms.arm = R * (mass.center - reference);
  terms.P = inertia_matrix(m, terms.arm, turned(R, mass.inertia));
  terms.Q << m * omega.cross(omega.cross(terms.arm)),
      omega.cross(terms.P.bottomRightCorner<3, 3>() * omega);
  terms.u << -m * gravity, -m * terms.arm.cross(gravity);
  return terms;
}

Matrix6 inverse_inertia(double mass,
                        const Eigen::Matrix3d& inverse_J,
                        const Eigen::Matrix3d& R,
                        const Eigen::Vector3d& arm) {
  const Eigen::Matrix3d J = turned(R, inverse_J);
  Matrix6 inverse = Matrix6::Zero();
  inverse.topLeftCorner<3, 3>().diagonal().setConstant(1 / mass);
  inverse.bottomRightCorner<3, 3>() = J;
  if (arm.isZero(0)) return inverse;
  const Eigen::Matrix3d S = skew(arm), SJ = S * J;
  inverse.topLeftCorner<3, 3>() += SJ * S.transpose();
  inverse.topRightCorner<3, 3>() = SJ;
  inverse.bottomLeftCorner<3, 3>() = SJ.transpose();
  return inverse;
}

Matrix6 inertia_rate(const MassProperties& mass,
                     const Eigen::Vector3d& reference,
                     const Eigen::Matrix3d& R,
                     const Eigen::Vector3d& omega) {
  const Eigen::Vector3d arm = R * (mass.center - reference);
  const Eigen::Matrix3d S = mass.mass * skew(omega.cross(arm)), W = skew(omega);
  const Eigen::Matrix3d J =
      inertia_matrix(mass.mass, arm, turned(R, mass.inertia)).bottomRightCorner<3, 3>();
  Matrix6 rate;
  rate << Eigen::Matrix3d::Zero(), S.transpose(), S, W * J - J * W;
  return rate;
}

}  // namespace condyle
