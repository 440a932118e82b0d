#include "elements/contact.h"

#include <Eigen/Geometry>

#include <cmath>

#include "math/rotation.h"

namespace condyle {
namespace {

/// Two unit vectors that make a right-handed triad with n, without a singular direction [Duff et
/// al. 2017].
Eigen::Matrix<double, 3, 2> tangents(const Eigen::Vector3d& n) {
  const double sign = std::copysign(1.0, n.z());
  const double a = -1 / (sign + n.z());
  const double b = n.x() * n.y() * a;
  Eigen::Matrix<double, 3, 2> T;
  T << 1 + sign * n.x() * n.x() * a, b, sign * b, sign + n.y() * n.y() * a, -sign * n.x(), -n.y();
  return T;
}

double away_from_zero(double x) {
  return std::abs(x) < kFlatCurvature ? std::copysign(kFlatCurvature, x == 0 ? -1.0 : x) : x;
}

}  // namespace

ContactLinearization linearize_contact(const Surface& on_B,
                                       const Place& place_B,
                                       const Surface& on_A,
                                       const Place& place_A,
                                       const RigidTransform& X_BA) {
  ContactLinearization contact;
  contact.B = on_B.evaluate(place_B);
  contact.A = on_A.evaluate(place_A);
  const Eigen::Matrix3d& R = X_BA.R;
  const Eigen::Vector3d& n = contact.B.n;
  const Eigen::Vector3d s = R * contact.A.c, m = R * contact.A.n;
  contact.s = s;
  contact.m = m;
  contact.g = X_BA.p + s - contact.B.c;
  contact.h = n + m;
  contact.arm = s.cross(n);

  const Eigen::Matrix<double, 3, 2> T = tangents(n);
  // Tᵀ Kr and, with it, the equivalent curvature Q = Tᵀ (K + Kr) T.
  const Eigen::Matrix<double, 3, 2> RT = R.transpose() * T;
  const Eigen::Matrix<double, 3, 2> K_RT = contact.A.K * RT;
  const Eigen::Matrix<double, 3, 2> Kr_T = R * K_RT;
  const Eigen::Matrix<double, 3, 2> K_T = contact.B.K * T;
  const double q00 = T.col(0).dot(K_T.col(0)) + RT.col(0).dot(K_RT.col(0));
  const double q01 = T.col(0).dot(K_T.col(1)) + RT.col(0).dot(K_RT.col(1));
  const double q11 = T.col(1).dot(K_T.col(1)) + RT.col(1).dot(K_RT.col(1));
  const double mean = (q00 + q11) / 2, spread = std::hypot((q00 - q11) / 2, q01);
  contact.relative_curvature = {-(mean + spread), -(mean - spread)};

  // P = T Q⁻¹ Tᵀ; a principal value that vanishes is held away from zero, so the step stays finite.
  Eigen::Matrix2d Q_inverse;
  const double low = mean - spread, high = mean + spread;
  if (std::abs(low) > kFlatCurvature && std::abs(high) > kFlatCurvature) {
    const double d = 1 / (q00 * q11 - q01 * q01);
    Q_inverse << q11 * d, -q01 * d, -q01 * d, q00 * d;
  } else {
    Eigen::Vector2d e(q01, high - q00);
    if (e.squaredNorm() < 1e-30 * (1 + high * high))
      e = q00 >= q11 ? Eigen::Vector2d(1, 0) : Eigen::Vector2d(0, 1);
    e.normalize();
    const Eigen::Vector2d f(-e.y(), e.x());
    Q_inverse = e * e.transpose() / away_from_zero(high) + f * f.transpose() / away_from_zero(low);
  }
  // Rows of Tᵀ Kr [s]x: (Kr t) x s transposed.
  Eigen::Matrix<double, 2, 3> to_da = Kr_T.transpose();
  Eigen::Matrix<double, 2, 3> to_dpi;
  for (int k = 0; k < 2; ++k)
    to_dpi.row(k) = (m.cross(T.col(k)) + s.cross(Kr_T.col(k))).transpose();
  const Eigen::Vector2d to_0 = T.transpose() * contact.h + Kr_T.transpose() * contact.g;
  const Eigen::Matrix<double, 3, 2> TQ = T * Q_inverse;
  contact.D1.noalias() = TQ * to_da;
  contact.D2.noalias() = TQ * to_dpi;
  contact.D0.noalias() = TQ * to_0;
  return contact;
}

void add_contact_force(const ContactLinearization& contact, double p, Wrench& wrench) {
  // dF = dp n - p K dc;  dM = (dc - g - da) x F + s x dF
  const Eigen::Vector3d F = p * contact.B.n;
  const Eigen::Matrix3d pK = p * contact.B.K;
  const Eigen::Matrix3d F1 = -pK * contact.D1, F2 = -pK * contact.D2;
  const Eigen::Vector3d F0 = -pK * contact.D0;
  const Eigen::Matrix3d Fx = skew(F), sx = skew(contact.s);
  wrench.f += F + F0;
  wrench.m += contact.s.cross(F + F0) + (contact.D0 - contact.g).cross(F);
  wrench.F1 += F1;
  wrench.F2 += F2;
  wrench.M1.noalias() += sx * F1 - Fx * contact.D1;
  wrench.M1 += Fx;
  wrench.M2.noalias() += sx * F2 - Fx * contact.D2;
}

void slide_contact(const Surface& on_B,
                   Place& place_B,
                   const Surface& on_A,
                   Place& place_A,
                   const ContactLinearization& contact,
                   const RigidTransform& X_BA,
                   const Eigen::Vector3d& da,
                   const Eigen::Vector3d& dpi,
                   double longest_slide) {
  Eigen::Vector3d dc = contact.D0 + contact.D1 * da + contact.D2 * dpi;
  Eigen::Vector3d dc_A = dc - contact.g - da - dpi.cross(contact.s);
  const double longest = std::sqrt(std::max(dc.squaredNorm(), dc_A.squaredNorm()));
  if (longest > longest_slide) {
    dc *= longest_slide / longest;
    dc_A *= longest_slide / longest;
  }
  place_B = on_B.moved(place_B, contact.B, dc);
  place_A = on_A.moved(place_A, contact.A, X_BA.R.transpose() * dc_A);
}

}  // namespace condyle
