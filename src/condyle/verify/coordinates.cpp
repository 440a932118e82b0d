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

/// How far the angles are from where they have no derivative: the length of the node, 1 at best.
double node_length(const Scene& scene,
                   const ConditionDescription& condition,
                   const RigidTransform& X_BA) {
  if (condition.kind == ConditionKind::kRotation) return std::hypot(X_BA.R(2, 0), X_BA.R(2, 2));
  if (condition.kind == ConditionKind::kTranslation) return 1;
  return directions(scene, scene.joint->tibia, X_BA)
      .col(2)
      .cross(directions(scene, scene.joint->femur, X_BA).col(0))
      .norm();
}

}  // namespace

/// Central differences of the sixth order: exact to round-off with these steps.
Eigen::Matrix<double, 6, 1> gradient(const Scene& scene,
                                     const ConditionDescription& condition,
                                     const RigidTransform& X_BA,
                                     const Vector3d& about) {
  if (condition.kind == ConditionKind::kDistance) {  // may be too short for steps
    const bool first = condition.ends[0].body == scene.moving_body();
    const Vector3d on_A = in_ground(scene, condition.ends[first ? 0 : 1], X_BA),
                   e = (on_A - condition.ends[first ? 1 : 0].at).normalized();
    Eigen::Matrix<double, 6, 1> out;
    out << e, (on_A - about).cross(e);
    return out;
  }
  constexpr double kWeights[] = {45.0 / 60, -9.0 / 60, 1.0 / 60};
  constexpr double kLength = 0.1;  // [mm]
  const double angle_step =
      std::max(1e-6, 4e-3 * std::min(1.0, 4 * node_length(scene, condition, X_BA)));  // [rad]
  Eigen::Matrix<double, 6, 1> out;
  for (int i = 0; i < 6; ++i) {
    const double h = i < 3 ? kLength : angle_step;
    const auto at = [&](double step) {
      const Vector3d way = step * Vector3d::Unit(i % 3), none = Vector3d::Zero();
      return coordinate(scene, condition,
                        i < 3 ? moved(X_BA, way, none, about) : moved(X_BA, none, way, about));
    };
    double sum = 0;
    for (int k = 1; k <= 3; ++k)
      sum += kWeights[k - 1] * difference(condition, at(k * h), at(-k * h));
    out[i] = sum / h;
  }
  return out;
}

}  // namespace condyle::verification
