#include "condyle/equilibrium/carried_pose.h"

#include <cmath>

#include "condyle/math/decompositions.h"
#include "condyle/math/rotation.h"

namespace condyle {
namespace {

/// The joint coordinate that a condition prescribes; nullptr for one of another kind.
double* prescribed(ConditionKind kind, JointCoordinates& q) {
  switch (kind) {
    case ConditionKind::kFlexion:
      return &q.flexion;
    case ConditionKind::kAdduction:
      return &q.adduction;
    case ConditionKind::kInternalRotation:
      return &q.internal_rotation;
    case ConditionKind::kLateralShift:
      return &q.lateral_shift;
    case ConditionKind::kAnteriorDrawer:
      return &q.anterior_drawer;
    case ConditionKind::kDistraction:
      return &q.distraction;
    default:
      return nullptr;
  }
}

RigidTransform with_prescribed_joint_coordinates(const Model& model,
                                                 const Drive& drive,
                                                 const RigidTransform& X_BA) {
  JointCoordinates q = joint_coordinates(*model.joint, X_BA);
  bool any = false;
  for (std::size_t i = 0; i < model.conditions.size(); ++i) {
    double* coordinate = prescribed(model.conditions[i].kind, q);
    if (coordinate == nullptr) continue;
    *coordinate = drive.values[i];
    any = true;
  }
  return any ? pose_from_joint_coordinates(*model.joint, q) : X_BA;
}

/// One linear step of least motion towards all conditions; false where they hold.
bool step_to_conditions(const Model& model, const Drive& drive, RigidTransform& X) {
  const double L = model.length;
  const auto m = static_cast<Eigen::Index>(model.conditions.size());
  Eigen::MatrixXd rows(m, 6);
  Eigen::VectorXd off(m);
  for (Eigen::Index i = 0; i < m; ++i) {
    const auto condition = static_cast<std::size_t>(i);
    const ConditionDerivatives k =
        evaluate(model.conditions[condition], drive.values[condition], X);
    const double w = condition_weight(model, condition);
    rows.row(i) << w * k.alpha.transpose(), w * k.eta.transpose() / L;
    off[i] = w * k.k;
  }
  if (off.norm() < 1e-12 * L) return false;
  const Eigen::VectorXd step = least_norm_solution(rows, -off).x;
  if (!step.allFinite()) return false;
  X.p += step.head<3>();
  X.R = exp_rotation(step.tail<3>() / L) * X.R;
  return true;
}

}  // namespace

RigidTransform carried(const Model& model, const Drive& drive, const RigidTransform& X_BA) {
  check_drive(drive, model);
  constexpr int kSteps = 10;
  RigidTransform X = model.joint ? with_prescribed_joint_coordinates(model, drive, X_BA) : X_BA;
  for (int k = 0; k < kSteps && !model.conditions.empty() && step_to_conditions(model, drive, X);
       ++k) {
  }
  X.R = orthonormalized(X.R);
  return X;
}

}  // namespace condyle
