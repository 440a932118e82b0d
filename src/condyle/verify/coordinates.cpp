#include "condyle/verify/coordinates.h"

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

namespace condyle::verification {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

double right_or_left(const Scene& scene) { return scene.joint->side == Side::kRight ? 1 : -1; }

/// To the right of the body, forwards, upwards: columns in the ground frame.
Matrix3d directions(const Scene& scene, const AnatomicalFrame& frame, const RigidTransform& X_BA) {
  Matrix3d R;
  R << right_or_left(scene) * frame.lateral, frame.anterior, frame.proximal;
  return frame.body == scene.moving_body() ? Matrix3d(X_BA.R * R) : R;
}

Vector3d origin(const Scene& scene, const AnatomicalFrame& frame, const RigidTransform& X_BA) {
  return frame.body == scene.moving_body() ? Vector3d(X_BA * frame.origin) : frame.origin;
}

Matrix3d about_axis(double angle, const Vector3d& axis) { return turn(angle * axis); }

}  // namespace

Matrix3d turn(const Vector3d& theta) {
  const double angle = theta.norm();
  if (angle == 0) return Matrix3d::Identity();
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, theta / angle)).toRotationMatrix();
}

RigidTransform moved(const RigidTransform& X_BA,
                     const Vector3d& da,
                     const Vector3d& theta,
                     const Vector3d& about) {
  const Matrix3d Q = turn(theta);
  return {Q * X_BA.R, Q * (X_BA.p - about) + about + da};
}

std::array<double, 6> grood_suntay(const Scene& scene, const RigidTransform& X_BA) {
  const Matrix3d F = directions(scene, scene.joint->femur, X_BA),
                 T = directions(scene, scene.joint->tibia, X_BA);
  const Vector3d H =
      origin(scene, scene.joint->tibia, X_BA) - origin(scene, scene.joint->femur, X_BA);
  const Vector3d I = F.col(0), J = F.col(1), K = F.col(2), i = T.col(0), j = T.col(1), k = T.col(2);
  const Vector3d floating = k.cross(I).normalized();
  const double side = right_or_left(scene);
  return {std::atan2(k.dot(J), k.dot(K)),
          side * std::atan2(k.dot(I), k.cross(I).norm()),
          side * std::atan2(-I.dot(j), I.dot(i)),
          side * H.dot(I),
          H.dot(floating),
          -H.dot(k)};
}

RigidTransform start_of(const Scene& scene) {
  const BodyDescription& body = scene.bodies[static_cast<std::size_t>(scene.moving_body())];
  RigidTransform X{turn(body.start_rotation), body.start_translation};
  if (!body.start_joint_angles) return X;
  // The tibia turns about the femur's first axis by -flexion, about the floating one, about its own
  // last one.
  const auto& [flexion, adduction, internal] = *body.start_joint_angles;
  const double side = right_or_left(scene);
  const RigidTransform none;
  const Matrix3d F = directions(scene, scene.joint->femur, none),
                 T = directions(scene, scene.joint->tibia, none);
  const Matrix3d tibia_in_femur = about_axis(-flexion, Vector3d::UnitX()) *
                                  about_axis(side * adduction, Vector3d::UnitY()) *
                                  about_axis(side * internal, Vector3d::UnitZ());
  X.R = F * tibia_in_femur * T.transpose();
  if (scene.joint->femur.body == scene.moving_body()) X.R.transposeInPlace();
  return X;
}

Vector3d in_ground(const Scene& scene, const Attachment& end, const RigidTransform& X_BA) {
  return end.body == scene.moving_body() ? Vector3d(X_BA * end.at) : end.at;
}

Vector3d end_on_moving(const Scene& scene,
                       const ConditionDescription& distance,
                       const RigidTransform& X_BA) {
  const bool first = distance.ends[0].body == scene.moving_body();
  return in_ground(scene, distance.ends[first ? 0 : 1], X_BA);
}

double coordinate(const Scene& scene,
                  const ConditionDescription& condition,
                  const RigidTransform& X_BA) {
  const Matrix3d& R = X_BA.R;
  switch (condition.kind) {
    case ConditionKind::kTranslation:
      return condition.axis.dot(X_BA.p);
    case ConditionKind::kRotation:  // of R = Rz Rx' Ry''
      if (condition.cardan_axis == 0) return std::atan2(R(2, 1), std::hypot(R(2, 0), R(2, 2)));
      if (condition.cardan_axis == 1) return std::atan2(-R(2, 0), R(2, 2));
      return std::atan2(-R(0, 1), R(1, 1));
    case ConditionKind::kDistance:
      return (in_ground(scene, condition.ends[0], X_BA) - in_ground(scene, condition.ends[1], X_BA))
          .norm();
    default:
      return grood_suntay(scene, X_BA)[static_cast<std::size_t>(condition.kind)];
  }
}

double difference(const ConditionDescription& condition, double a, double b) {
  return is_angle(condition.kind) ? std::remainder(a - b, 2 * std::numbers::pi) : a - b;
}

namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

/// θ.w of each angle of a rotation about three axes, one after the other: the body turns by
/// θ = Σ dqᵢ eᵢ, so w are the vectors reciprocal to the axes.
std::array<Vector3d, 3> reciprocal(const Vector3d& e1, const Vector3d& e2, const Vector3d& e3) {
  const double volume = e1.dot(e2.cross(e3));
  return {e2.cross(e3) / volume, e3.cross(e1) / volume, e1.cross(e2) / volume};
}

/// Of R = Rz Rx' Ry'': by z of the ground, the node, and y of the body.
Vector3d cardan_gradient(int axis, const Matrix3d& R) {
  const Vector3d z = Vector3d::UnitZ(), y = R.col(1), node = y.cross(z).normalized();
  const auto [by_z, by_x, by_y] = reciprocal(z, node, y);
  return axis == 0 ? by_x : axis == 1 ? by_y : by_z;
}

/// A point and vectors that go with the body or stay, under a small motion da, θ about a point.
struct Motion {
  Vector3d about;
  /// Of a.x, x a point of the body.
  [[nodiscard]] Vector6 of_point(const Vector3d& a, const Vector3d& x) const {
    Vector6 out;
    out << a, (x - about).cross(a);
    return out;
  }
  /// Of a.v, v a vector of the body.
  [[nodiscard]] static Vector6 of_vector(const Vector3d& a, const Vector3d& v) {
    Vector6 out;
    out << Vector3d::Zero(), v.cross(a);
    return out;
  }
};

/// Flexion is about I of the femur, against the sense of the coordinate; adduction about the
/// floating axis; internal rotation about k of the tibia. Lengths are those of H = o_T - o_F along
/// the same axes.
Vector6 grood_suntay_gradient(const Scene& scene,
                              ConditionKind kind,
                              const RigidTransform& X_BA,
                              const Vector3d& about) {
  const AnatomicalFrame &femur = scene.joint->femur, &tibia = scene.joint->tibia;
  const bool femur_moves = femur.body == scene.moving_body();
  const Vector3d I = directions(scene, femur, X_BA).col(0),
                 k = directions(scene, tibia, X_BA).col(2);
  const Vector3d o_F = origin(scene, femur, X_BA), o_T = origin(scene, tibia, X_BA), H = o_T - o_F;
  const double node = k.cross(I).norm(), side = right_or_left(scene);
  const Vector3d floating = k.cross(I) / node;
  const Motion motion{about};
  // H.a with an axis a that stays: one of both origins moves.
  const auto along = [&](const Vector3d& a) {
    return femur_moves ? Vector6(-motion.of_point(a, o_F)) : motion.of_point(a, o_T);
  };
  const auto angle = [&](double sign, int axis) {
    Vector6 out;
    out << Vector3d::Zero(),
        (femur_moves ? -sign : sign) * reciprocal(I, floating, k)[static_cast<std::size_t>(axis)];
    return out;
  };
  switch (kind) {
    case ConditionKind::kFlexion:
      return angle(-1, 0);
    case ConditionKind::kAdduction:
      return angle(side, 1);
    case ConditionKind::kInternalRotation:
      return angle(side, 2);
    case ConditionKind::kLateralShift:
      return side * (along(I) + (femur_moves ? Motion::of_vector(H, I) : Vector6::Zero()));
    case ConditionKind::kAnteriorDrawer: {
      // The floating axis turns with k or with I, but for what is along it.
      const Vector3d w = (H - floating * floating.dot(H)) / node;
      return along(floating) +
             (femur_moves ? Motion::of_vector(w.cross(k), I) : Motion::of_vector(I.cross(w), k));
    }
    default:  // distraction
      return -(along(k) + (femur_moves ? Vector6::Zero() : Motion::of_vector(H, k)));
  }
}

}  // namespace

Vector6 gradient(const Scene& scene,
                 const ConditionDescription& condition,
                 const RigidTransform& X_BA,
                 const Vector3d& about) {
  const Motion motion{about};
  switch (condition.kind) {
    case ConditionKind::kTranslation:
      return motion.of_point(condition.axis, X_BA.p);
    case ConditionKind::kRotation: {
      Vector6 out;
      out << Vector3d::Zero(), cardan_gradient(condition.cardan_axis, X_BA.R);
      return out;
    }
    case ConditionKind::kDistance: {
      const bool first = condition.ends[0].body == scene.moving_body();
      const Vector3d on_A = end_on_moving(scene, condition, X_BA);
      return motion.of_point((on_A - condition.ends[first ? 1 : 0].at).normalized(), on_A);
    }
    default:
      return grood_suntay_gradient(scene, condition.kind, X_BA, about);
  }
}

}  // namespace condyle::verification
