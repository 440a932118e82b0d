#include "condyle/equilibrium/joint_stiffness.h"

#include <algorithm>

#include "condyle/equilibrium/admissible_motions.h"
#include "condyle/math/decompositions.h"

namespace condyle {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

constexpr double kSingular = 1e-9;  // relative, of pivots

constexpr std::array<ConditionKind, 6> kCoordinates = {
    ConditionKind::kFlexion,      ConditionKind::kAdduction,      ConditionKind::kInternalRotation,
    ConditionKind::kLateralShift, ConditionKind::kAnteriorDrawer, ConditionKind::kDistraction};

/// (da, L dπ) from (da, dπ).
Vector6 rotation_scale(double L) { return (Vector6() << 1, 1, 1, L, L, L).finished(); }
/// The same for joint coordinates: angles come first.
Vector6 angle_scale(double L) { return (Vector6() << L, L, L, 1, 1, 1).finished(); }

}  // namespace

Matrix6 joint_jacobian(const JointFrames& frames, const RigidTransform& X_BA) {
  Matrix6 J;
  KinematicCondition condition;
  condition.frames = frames;
  for (std::size_t i = 0; i < kCoordinates.size(); ++i) {
    condition.kind = kCoordinates[i];
    const ConditionDerivatives k = evaluate(condition, 0, X_BA);
    J.row(static_cast<Eigen::Index>(i)) << k.alpha.transpose(), k.eta.transpose();
  }
  return J;
}

std::optional<JointStiffness> joint_stiffness(const Linearization& at) {
  if (!at.model.joint) return std::nullopt;
  const double L = at.model.length;
  // Scaled: motions (da, L dπ), coordinates with angles as L dq.
  const Vector6 motions = rotation_scale(L), coordinates = angle_scale(L);
  const Matrix6 J = coordinates.asDiagonal() * joint_jacobian(*at.model.joint, at.state.X) *
                    motions.cwiseInverse().asDiagonal();
  const Matrix6 K = scaled_stiffness(at.wrench(), L);
  const double largest = std::max(K.cwiseAbs().maxCoeff(), at.force_scale() / L);

  const std::optional<SmallMatrix> regular = regular_inverse(J, 1e-6);
  if (!K.allFinite() || !regular) return std::nullopt;
  const Matrix6 J_inverse = *regular;

  const Motions Z = admissible_motions(at);
  Matrix6 yielding = Matrix6::Zero();
  if (Z.cols() > 0) {
    const std::optional<SmallMatrix> inner =
        regular_inverse(Z.transpose() * K * Z, kSingular * largest);
    if (!inner) return std::nullopt;
    yielding = Z * *inner * Z.transpose();
  }
  JointStiffness joint;
  joint.stiffness =
      coordinates.asDiagonal() * (J_inverse.transpose() * K * J_inverse) * coordinates.asDiagonal();
  joint.compliance = coordinates.cwiseInverse().asDiagonal() * (J * yielding * J.transpose()) *
                     coordinates.cwiseInverse().asDiagonal();
  return joint;
}

}  // namespace condyle
