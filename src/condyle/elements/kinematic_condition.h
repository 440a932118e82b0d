#pragma once

/// Kinematic conditions k(a,R) = 0: a prescribed part of the motion [Dortmans 1986, 2.59-2.61, App.
/// D].
///
/// dk = α.da + η.dπ and, for the Newton system, dα = D1 da + D2 dπ, dη = D3 da + D4 dπ. The load on
/// A is f = -σ α, m = -σ η about O_A, with the multiplier σ: it does no power on admissible motions
/// (2.111).

#include "condyle/elements/joint_coordinates.h"
#include "condyle/math/rigid_transform.h"

namespace condyle {

enum class ConditionKind {
  kFlexion,
  kAdduction,
  kInternalRotation,  ///< Grood-Suntay angles [rad]; need [joint]
  kLateralShift,
  kAnteriorDrawer,
  kDistraction,  ///< Grood-Suntay translations [mm]; need [joint]
  kTranslation,  ///< of a point of A along `axis` (ground frame) [mm]
  kRotation,     ///< Cardan angle of R = Rz Rx' Ry'' about x, y or z [rad]
  kDistance      ///< between two ends: an isometric fibre [mm]
};

/// Is the coordinate of this kind of condition an angle, or else a length?
[[nodiscard]] constexpr bool is_angle(ConditionKind kind) {
  return kind <= ConditionKind::kInternalRotation || kind == ConditionKind::kRotation;
}

struct KinematicCondition {
  ConditionKind kind = ConditionKind::kFlexion;
  double value = 0;                                 ///< prescribed nominally [rad] or [mm]
  JointFrames frames;                               ///< Grood-Suntay kinds
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();  ///< kTranslation: unit vector, ground frame
  int cardan_axis = 0;                              ///< kRotation: 0 x, 1 y, 2 z of R = Rz Rx' Ry''
  /// kDistance: its ends; kTranslation: from which point to which, by themselves O_B and O_A.
  Eigen::Vector3d x_C = Eigen::Vector3d::Zero();  ///< of B, ground frame [mm]
  Eigen::Vector3d s_D = Eigen::Vector3d::Zero();  ///< of A, A's frame [mm]
};

struct ConditionDerivatives {
  double coordinate;           ///< the coordinate itself [rad] or [mm], angles in (-π, π]
  double k;                    ///< coordinate - value, angles wrapped to (-π, π]
  Eigen::Vector3d alpha, eta;  ///< ∂k/∂a, ∂k/∂π
  Eigen::Matrix3d D1, D2, D3, D4;
  /// |m x b|, the sine of the angle between the first and the last axis of an angle; where it vanishes
  /// the coordinate has no derivative. 1 for what has no such axes.
  double node = 1;
};

/// `value` is prescribed [rad] or [mm]. Finite everywhere except where the coordinate itself has no
/// derivative (Cardan angle y or z at cos(x) = 0, flexion at ±90° of adduction, a distance of zero):
/// there it returns what the formula gives with the denominator bounded away from zero by 1e-12,
/// never NaN.
[[nodiscard]] ConditionDerivatives evaluate(const KinematicCondition& condition,
                                            double value,
                                            const RigidTransform& X_BA);

}  // namespace condyle
