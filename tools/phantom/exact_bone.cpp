#include "phantom/exact_bone.h"

#include <cmath>

#include "phantom/femur.h"
#include "phantom/tibia.h"

namespace condyle::phantom {

/// A point near the articular surface of the compartment: on the femur along the direction from the
/// centre of the condyle, on the tibia above or below p. Both before the bone is sized.
Eigen::Vector3d ExactBone::near_surface(const Eigen::Vector3d& q) const {
  const double z = side_ * std::clamp(side_ * q.z(), 12.0, 34.0);
  if (bone_ == Bone::kTibia) {
    const double x = std::clamp(q.x(), -17.0, 24.0);
    return {x, tibial_height<double>(knee_.tibia, x, z), z};
  }
  const Condyle& c = side_ < 0 ? knee_.femur.medial : knee_.femur.lateral;
  const double angle = std::clamp(std::atan2(-q.x(), -q.y()), -40 * kDegree, 140 * kDegree);
  const double r = outline_radius<double>(c, angle);
  return {-r * std::sin(angle), -r * std::cos(angle), z};
}

SurfacePoint ExactBone::evaluate(const Place& place) const {
  const ShapeValue s = shape_derivatives(bone_, place.numbers - origin_, knee_);
  const double slope = s.g.norm();
  SurfacePoint point;
  point.c = place.numbers;
  point.n = s.g / slope;
  const Eigen::Matrix3d P = Eigen::Matrix3d::Identity() - point.n * point.n.transpose();
  point.K = -(P * s.h * P) / slope;
  point.dual.setZero();
  return point;
}

Place ExactBone::moved(const Place& place,
                       const SurfacePoint& at,
                       const Eigen::Vector3d& dc) const {
  return {origin_ + project(bone_, place.numbers - origin_ + dc - dc.dot(at.n) * at.n, knee_)};
}

Place ExactBone::closest(const Eigen::Vector3d& p, const Place&) const {
  return {origin_ + project(bone_, p - origin_, knee_)};
}

Place ExactBone::seed(const Eigen::Vector3d& p) const {
  const Eigen::Vector3d near = near_surface(unsized(bone_, p - origin_, knee_));
  return {origin_ + project(bone_, sized(bone_, near, knee_), knee_)};
}

std::vector<Place> ExactBone::samples(double spacing) const {
  std::vector<Place> places;
  const auto add = [&](const Eigen::Vector3d& q) {
    places.push_back({origin_ + project(bone_, sized(bone_, near_surface(q), knee_), knee_)});
  };
  for (double z = 13; z <= 33; z += spacing) {
    if (bone_ == Bone::kTibia) {
      for (double x = -16; x <= 22; x += spacing) add({x, 0, side_ * z});
    } else {
      for (double a = -35; a <= 135; a += spacing / 22 / kDegree)
        add({-std::sin(a * kDegree), -std::cos(a * kDegree), side_ * z});
    }
  }
  return places;
}

Extent ExactBone::extent() const {
  const std::vector<Place> places = samples(4);
  const auto n = static_cast<double>(places.size());
  Extent extent{Eigen::Vector3d::Zero(), 0};
  for (const Place& place : places) extent.center += place.numbers / n;
  double square = 0;
  for (const Place& place : places) square += (place.numbers - extent.center).squaredNorm() / n;
  extent.radius = std::sqrt(square);
  return extent;
}

std::unique_ptr<Surface> ExactBone::translated(const Eigen::Vector3d& d) const {
  auto copy = std::make_unique<ExactBone>(*this);
  copy->origin_ += d;
  return copy;
}

}  // namespace condyle::phantom
