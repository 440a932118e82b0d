#include "condyle/reference/wismans_system.h"

#include <cmath>

#include "condyle/math/rotation.h"
#include "condyle/reference/joint_rotation.h"

namespace condyle {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Generalised coordinates: 0 to 2 are a, 3 to 5 flexion, adduction, internal rotation.
constexpr int kFlexion = 3;
/// Their places among the unknowns; flexion is prescribed.
constexpr int kUnknownOf[6] = {0, 1, 2, -1, wismans::kAdduction, wismans::kInternalRotation};
constexpr int kWorkRow = 10;

/// A point of A, x = a + R s, with its derivatives in the generalised coordinates.
struct MovedPoint {
  Vector3d x, x_i[6], x_ij[6][6];

  MovedPoint(const Vector3d& a, const JointRotation& rotation, const Vector3d& s) {
    x = a + rotation.R * s;
    for (int i = 0; i < 6; ++i) {
      x_i[i] = i < 3 ? Vector3d(Vector3d::Unit(i)) : Vector3d(rotation.d[i - 3] * s);
      for (int j = 0; j < 6; ++j)
        x_ij[i][j] =
            i < 3 || j < 3 ? Vector3d(Vector3d::Zero()) : Vector3d(rotation.dd[i - 3][j - 3] * s);
    }
  }
};

/// Generalised forces and their derivatives.
struct Work {
  Vector6 Q = Vector6::Zero();
  Matrix6 dQ = Matrix6::Zero();
  double force_scale = 0;
};

/// L L_i = d.x_i and L L_ij = x_i.x_j + d.x_ij - L_i L_j.
void add_spring(const LineElement& spring,
                const Vector3d& a,
                const JointRotation& rotation,
                Work& work) {
  const MovedPoint end(a, rotation, spring.s_D);
  const Vector3d d = end.x - spring.x_C;
  const double L = d.norm();
  const Tension t = tension(spring.law, L);
  Vector6 L_i;
  for (int i = 0; i < 6; ++i) L_i[i] = d.dot(end.x_i[i]) / L;
  work.Q -= t.force * L_i;
  work.force_scale += std::abs(t.force);
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) {
      const double L_ij =
          (end.x_i[i].dot(end.x_i[j]) + d.dot(end.x_ij[i][j]) - L_i[i] * L_i[j]) / L;
      work.dQ(i, j) -= t.slope * L_i[i] * L_i[j] + t.force * L_ij;
    }
  }
}

/// Q_i = F.x_i; a follower force R f turns with the body.
void add_force(const Load& load, const Vector3d& a, const JointRotation& rotation, Work& work) {
  const MovedPoint point(a, rotation, load.at);
  const Vector3d f = load.scale * load.vector;
  const Vector3d F = load.follows_body ? Vector3d(rotation.R * f) : f;
  work.force_scale += f.norm();
  for (int i = 0; i < 6; ++i) {
    work.Q[i] += F.dot(point.x_i[i]);
    for (int j = 0; j < 6; ++j) {
      work.dQ(i, j) += F.dot(point.x_ij[i][j]);
      if (load.follows_body && j >= 3) work.dQ(i, j) += (rotation.d[j - 3] * f).dot(point.x_i[i]);
    }
  }
}

/// The power of a moment, M.w with [w]x = R_i Rᵀ, is half the trace of [M]xᵀ R_i Rᵀ. A follower has
/// M = R m, and [M]x = R [m]x Rᵀ.
void add_moment(const Load& load, const JointRotation& rotation, Work& work) {
  const Matrix3d W = skew(load.scale * load.vector).transpose();
  const auto half_trace = [&](const Matrix3d& A) { return 0.5 * (W * A).trace(); };
  for (int i = 0; i < 3; ++i) {
    const Matrix3d& R_i = rotation.d[i];
    const Matrix3d turning = load.follows_body ? Matrix3d(rotation.R.transpose() * R_i)
                                               : Matrix3d(R_i * rotation.R.transpose());
    work.Q[3 + i] += half_trace(turning);
    for (int j = 0; j < 3; ++j) {
      const Matrix3d &R_j = rotation.d[j], &R_ij = rotation.dd[i][j];
      work.dQ(3 + i, 3 + j) +=
          load.follows_body ? half_trace(R_j.transpose() * R_i + rotation.R.transpose() * R_ij)
                            : half_trace(R_ij * rotation.R.transpose() + R_i * R_j.transpose());
    }
  }
}

Work springs_and_loads(const WismansModel& model,
                       const Vector3d& a,
                       const JointRotation& rotation) {
  Work work;
  for (const LineElement& spring : model.springs) add_spring(spring, a, rotation, work);
  for (const Load& load : model.loads) {
    if (load.moment)
      add_moment(load, rotation, work);
    else
      add_force(load, a, rotation, work);
  }
  return work;
}

void add_contact(const WismansContact& contact,
                 int index,
                 const WismansVector& unknowns,
                 const JointRotation& rotation,
                 WismansSystem& system) {
  const int row = 5 * index, on_B = wismans::on_B(index), on_A = wismans::on_A(index),
            force = wismans::kForce + index;
  const HeightPoint B = evaluate(contact.on_B, unknowns.segment<2>(on_B));
  const HeightPoint A = evaluate(contact.on_A, unknowns.segment<2>(on_A));
  const MovedPoint at(unknowns.head<3>(), rotation, A.c);
  const double p = unknowns[force];
  WismansVector& r = system.residual;
  WismansMatrix& J = system.jacobian;

  r.segment<3>(row) = B.c - at.x;
  const Vector3d m = rotation.R * A.n;
  for (int k = 0; k < 2; ++k) r[row + 3 + k] = B.t[k].dot(m);
  for (int l = 0; l < 2; ++l) {
    J.block<3, 1>(row, on_B + l) = B.t[l];
    J.block<3, 1>(row, on_A + l) = -rotation.R * A.t[l];
    for (int k = 0; k < 2; ++k) {
      J(row + 3 + k, on_B + l) = B.c_xx[k][l].dot(m);
      J(row + 3 + k, on_A + l) = B.t[k].dot(rotation.R * A.n_x[l]);
    }
  }
  for (int i = 0; i < 6; ++i) {
    const int column = kUnknownOf[i];
    if (column >= 0) {
      J.block<3, 1>(row, column) = -at.x_i[i];
      for (int k = 0; k < 2 && i >= 3; ++k)
        J(row + 3 + k, column) = B.t[k].dot(rotation.d[i - 3] * A.n);
    }
    r[kWorkRow + i] += p * B.n.dot(at.x_i[i]);
    J(kWorkRow + i, force) = B.n.dot(at.x_i[i]);
    for (int l = 0; l < 2; ++l) {
      J(kWorkRow + i, on_B + l) = p * B.n_x[l].dot(at.x_i[i]);
      if (i >= 3) J(kWorkRow + i, on_A + l) = p * B.n.dot(rotation.d[i - 3] * A.t[l]);
    }
    for (int j = 0; j < 6; ++j) {
      if (kUnknownOf[j] >= 0) J(kWorkRow + i, kUnknownOf[j]) += p * B.n.dot(at.x_ij[i][j]);
    }
  }
  system.force_scale += std::abs(p);
}

Vector3d angles_of(const WismansModel& model, const WismansVector& unknowns) {
  return {model.flexion, unknowns[wismans::kAdduction], unknowns[wismans::kInternalRotation]};
}

}  // namespace

WismansSystem assemble(const WismansModel& model, const WismansVector& unknowns) {
  const JointRotation rotation = joint_rotation(model.joint, angles_of(model, unknowns));
  WismansSystem system;
  system.residual.setZero();
  system.jacobian.setZero();
  const Work work = springs_and_loads(model, unknowns.head<3>(), rotation);
  system.force_scale = work.force_scale;
  system.residual.segment<6>(kWorkRow) = work.Q;
  for (int j = 0; j < 6; ++j) {
    if (kUnknownOf[j] >= 0) system.jacobian.block<6, 1>(kWorkRow, kUnknownOf[j]) = work.dQ.col(j);
  }
  for (int c = 0; c < 2; ++c)
    add_contact(model.contacts[static_cast<std::size_t>(c)], c, unknowns, rotation, system);
  system.residual[kWorkRow + kFlexion] -= unknowns[wismans::kMoment];
  system.jacobian(kWorkRow + kFlexion, wismans::kMoment) = -1;
  return system;
}

RigidTransform pose_of(const WismansModel& model, const WismansVector& unknowns) {
  return {joint_rotation(model.joint, angles_of(model, unknowns)).R, unknowns.head<3>()};
}

}  // namespace condyle
