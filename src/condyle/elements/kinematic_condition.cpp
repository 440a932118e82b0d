#include "condyle/elements/kinematic_condition.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "condyle/math/rotation.h"

namespace condyle {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kSmallest = 1e-12;  ///< bound on denominators

double wrapped(double angle) {
  constexpr double pi = std::numbers::pi;
  if (angle > -pi && angle <= pi) return angle;
  const double r = std::remainder(angle, 2 * pi);
  return r <= -pi ? pi : r;
}

/// Every rotation of the joint is described by an axis b fixed to B and an axis m fixed to A: A
/// spins about b, about the node v/c (v = m x b, c = |v|) and about m. With s = m.b these have
/// ∂s/∂π = v, ∂v/∂π = m bᵀ - s I = V and ∂m/∂π = -[m]x; the gradients below are the basis dual to
/// (b, v/c, m).
struct AxisPair {
  Vector3d b, m, v;
  double s, c;

  AxisPair(const Vector3d& fixed, const Vector3d& moving)
      : b(fixed),
        m(moving),
        v(moving.cross(fixed)),
        s(moving.dot(fixed)),
        c(std::max(v.norm(), kSmallest)) {}

  [[nodiscard]] Matrix3d V() const {
    Matrix3d result = m * b.transpose();
    result.diagonal().array() -= s;
    return result;
  }
};

void set_angle(double angle, ConditionDerivatives& out) { out.coordinate = wrapped(angle); }

/// Angle of spin about b: η = (b - s m)/c².
void spin_about_fixed(const AxisPair& p, double sign, ConditionDerivatives& out) {
  const double w2 = 1 / (p.c * p.c);
  const Vector3d g = w2 * (p.b - p.s * p.m);
  out.eta = sign * g;
  out.D4.noalias() = (sign * (2 * p.s * w2 * g - w2 * p.m)) * p.v.transpose();
  out.D4 += skew(sign * w2 * p.s * p.m);
}

/// Angle of spin about m: η = (m - s b)/c².
void spin_about_moving(const AxisPair& p, double sign, ConditionDerivatives& out) {
  const double w2 = 1 / (p.c * p.c);
  const Vector3d g = w2 * (p.m - p.s * p.b);
  out.eta = sign * g;
  out.D4.noalias() = (sign * (2 * p.s * w2 * g - w2 * p.b)) * p.v.transpose();
  out.D4 -= skew(sign * w2 * p.m);
}

/// Angle of spin about the node, asin s: η = v/c.
void spin_about_node(const AxisPair& p, double sign, ConditionDerivatives& out) {
  const double w = 1 / p.c;
  out.eta = sign * w * p.v;
  out.D4.noalias() = sign * w * p.V();
  out.D4.noalias() += (p.s * w * w * out.eta) * p.v.transpose();
}

/// Cardan angles of R = Rz(φ) Rx'(ψ) Ry''(ω): b = e_z, m = R e_y; ω is the spin about m, φ about b.
void cardan_angle(const KinematicCondition& condition,
                  const Matrix3d& R,
                  ConditionDerivatives& out) {
  const AxisPair p(Vector3d::UnitZ(), R.col(1));
  out.node = p.v.norm();
  switch (condition.cardan_axis) {
    case 0:
      set_angle(std::atan2(p.s, p.v.norm()), out);
      return spin_about_node(p, 1, out);
    case 1:
      set_angle(std::atan2(-R(2, 0), R(2, 2)), out);
      return spin_about_moving(p, 1, out);
    default:
      set_angle(std::atan2(-R(0, 1), R(1, 1)), out);
      return spin_about_fixed(p, 1, out);
  }
}

/// The joint at a pose. With a moving femur the motion of the tibia against it is -dπ: σ = -1.
struct JointPose {
  const JointFrames& frames;
  const RigidTransform& X_BA;
  double sigma;
  Vector3d e1, e3;

  JointPose(const JointFrames& joint, const RigidTransform& X)
      : frames(joint),
        X_BA(X),
        sigma(joint.tibia_moves ? 1 : -1),
        e1(femur_axis(0)),
        e3(tibia_axis(2)) {}

  [[nodiscard]] Vector3d femur_axis(int i) const {
    if (frames.tibia_moves) return frames.X_F.R.col(i);
    return X_BA.R * frames.X_F.R.col(i);
  }
  [[nodiscard]] Vector3d tibia_axis(int i) const {
    if (frames.tibia_moves) return X_BA.R * frames.X_T.R.col(i);
    return frames.X_T.R.col(i);
  }
  [[nodiscard]] AxisPair axes() const {
    return frames.tibia_moves ? AxisPair(e1, e3) : AxisPair(e3, e1);
  }
};

/// The tibia turns by -flexion about e1, adduction about the node, internal rotation about e3;
/// turning the femur by dπ undoes what turning the tibia does, so fixed and moving axis and the
/// signs change places.
void joint_angle(const KinematicCondition& condition,
                 const RigidTransform& X_BA,
                 ConditionDerivatives& out) {
  const JointPose pose(condition.frames, X_BA);
  const AxisPair axes = pose.axes();
  out.node = axes.v.norm();
  const double side = condition.frames.side, sigma = pose.sigma;
  const bool tibia_moves = condition.frames.tibia_moves;
  if (condition.kind == ConditionKind::kAdduction) {
    set_angle(side * std::atan2(axes.s, axes.v.norm()), out);
    return spin_about_node(axes, side, out);
  }
  const bool flexion = condition.kind == ConditionKind::kFlexion;
  if (flexion) {
    set_angle(std::atan2(pose.e3.dot(pose.femur_axis(1)), pose.e3.dot(pose.femur_axis(2))), out);
  } else {
    const double y = -pose.e1.dot(pose.tibia_axis(1)), x = pose.e1.dot(pose.tibia_axis(0));
    set_angle(side * std::atan2(y, x), out);
  }
  const double sign = flexion ? -sigma : side * sigma;
  if (flexion == tibia_moves) return spin_about_fixed(axes, sign, out);
  return spin_about_moving(axes, sign, out);
}

/// H from the femoral to the tibial origin: dH = σ (da + dπ x q), q the arm of the moving origin
/// about O_A.
struct OriginDistance {
  Vector3d q, H;
  double sigma;

  OriginDistance(const JointFrames& frames, const RigidTransform& X_BA)
      : sigma(frames.tibia_moves ? 1 : -1) {
    q = X_BA.R * (frames.tibia_moves ? frames.X_T.p : frames.X_F.p);
    H = frames.tibia_moves ? Vector3d(X_BA.p + q - frames.X_F.p)
                           : Vector3d(frames.X_T.p - X_BA.p - q);
  }
};

/// H.e with e fixed to B or turning with A, ∂e/∂π = E:  α = σ e,  η = σ q x e + EᵀH.
void along_body_axis(const OriginDistance& h,
                     const Vector3d& e,
                     bool moving,
                     double sign,
                     ConditionDerivatives& out) {
  const Matrix3d Q = skew(h.q);
  out.coordinate = sign * h.H.dot(e);
  out.alpha = sign * h.sigma * e;
  out.eta = sign * h.sigma * h.q.cross(e);
  out.D4 = h.sigma * h.q * e.transpose();
  out.D4.diagonal().array() -= h.sigma * h.q.dot(e);
  if (moving) {
    const Matrix3d W = skew(e);  // E = -W, EᵀH = e x H
    out.eta += sign * e.cross(h.H);
    out.D2 = -sign * h.sigma * W;
    out.D3 = sign * h.sigma * W;
    out.D4 += skew(h.H) * W - h.sigma * (Q * W + W * Q);
  }
  out.D4 *= sign;
}

/// H.e2 = σ H.v/c: the quotient of y = σ H.v, with n = σ v and ∂n/∂π = N = σ V, and c, with 1/c =
/// w.
void along_node(const OriginDistance& h, const AxisPair& p, ConditionDerivatives& out) {
  const double w = 1 / p.c, sigma = h.sigma;
  const Matrix3d Q = skew(h.q), V = p.V();
  const Vector3d n = sigma * p.v, g_w = p.s * w * w * w * p.v;
  const double y = h.H.dot(n);
  const Vector3d eta_y = sigma * (h.q.cross(n) + V.transpose() * h.H);
  // ∂(VᵀH)/∂π with VᵀH = b (m.H) - s H
  const Matrix3d D_VH = p.b * (p.m.cross(h.H) + sigma * h.q.cross(p.m)).transpose() -
                        h.H * p.v.transpose() + sigma * p.s * Q;
  Matrix3d D4_y = sigma * (h.q * n.transpose() + sigma * Q * V + D_VH);
  D4_y.diagonal().array() -= sigma * h.q.dot(n);
  const Matrix3d G_w =
      w * w * w * (p.v * p.v.transpose() + p.s * V) + 3 * p.s * w * w * p.v * g_w.transpose();

  out.node = p.v.norm();
  out.coordinate = y * w;
  out.alpha = w * sigma * n;
  out.eta = w * eta_y + y * g_w;
  out.D2 = w * V + sigma * n * g_w.transpose();  // ∂(w σ n)/∂π, σ² = 1
  out.D3 = out.D2.transpose();
  out.D4 = w * D4_y + eta_y * g_w.transpose() + g_w * eta_y.transpose() + y * G_w;
}

void joint_translation(const KinematicCondition& condition,
                       const RigidTransform& X_BA,
                       ConditionDerivatives& out) {
  const JointPose pose(condition.frames, X_BA);
  const OriginDistance h(condition.frames, X_BA);
  const bool tibia_moves = condition.frames.tibia_moves;
  if (condition.kind == ConditionKind::kLateralShift) {
    along_body_axis(h, pose.e1, !tibia_moves, condition.frames.side, out);
  } else if (condition.kind == ConditionKind::kDistraction) {
    along_body_axis(h, pose.e3, tibia_moves, -1, out);
  } else {
    along_node(h, pose.axes(), out);
  }
}

/// e.(a + q - x_C), q = R s_D: η = q x e.
void translation(const KinematicCondition& condition,
                 const RigidTransform& X_BA,
                 ConditionDerivatives& out) {
  const Vector3d& e = condition.axis;
  const Vector3d q = X_BA.R * condition.s_D;
  out.coordinate = e.dot(X_BA.p + q - condition.x_C);
  out.alpha = e;
  out.eta = q.cross(e);
  out.D4.noalias() = q * e.transpose();
  out.D4.diagonal().array() -= q.dot(e);
}

/// |d|, d = a + q - x_C: α = e = d/L, η = q x e, ∂e/∂a = P = (I - eeᵀ)/L.
void distance(const KinematicCondition& condition,
              const RigidTransform& X_BA,
              ConditionDerivatives& out) {
  const Vector3d q = X_BA.R * condition.s_D;
  const Vector3d d = X_BA.p + q - condition.x_C;
  out.coordinate = d.norm();
  const double L = std::max(out.coordinate, kSmallest);
  const Vector3d e = d / L;
  const Matrix3d P = (Matrix3d::Identity() - e * e.transpose()) / L, Q = skew(q);
  out.alpha = e;
  out.eta = q.cross(e);
  out.D1 = P;
  out.D3.noalias() = Q * P;
  out.D2 = out.D3.transpose();
  out.D4.noalias() = q * e.transpose() - out.D3 * Q;
  out.D4.diagonal().array() -= q.dot(e);
}

}  // namespace

ConditionDerivatives evaluate(const KinematicCondition& condition,
                              double value,
                              const RigidTransform& X_BA) {
  ConditionDerivatives out;
  for (Vector3d* v : {&out.alpha, &out.eta}) v->setZero();
  for (Matrix3d* D : {&out.D1, &out.D2, &out.D3, &out.D4}) D->setZero();
  switch (condition.kind) {
    case ConditionKind::kFlexion:
    case ConditionKind::kAdduction:
    case ConditionKind::kInternalRotation:
      joint_angle(condition, X_BA, out);
      break;
    case ConditionKind::kLateralShift:
    case ConditionKind::kAnteriorDrawer:
    case ConditionKind::kDistraction:
      joint_translation(condition, X_BA, out);
      break;
    case ConditionKind::kTranslation:
      translation(condition, X_BA, out);
      break;
    case ConditionKind::kRotation:
      cardan_angle(condition, X_BA.R, out);
      break;
    case ConditionKind::kDistance:
      distance(condition, X_BA, out);
      break;
  }
  const double off = out.coordinate - value;
  out.k = is_angle(condition.kind) ? wrapped(off) : off;
  return out;
}

}  // namespace condyle
