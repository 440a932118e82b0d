#pragma once

/// The surfaces that ligaments wrap on as level sets f = 0, f < 0 inside, in their own frames [mm].

#include "condyle/scene/scene.h"

namespace condyle::verification {

struct Field {
  double f = 0;
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
};

/// Half the thickness of a ligament larger.
[[nodiscard]] Field field_at(const WrapShape& shape, double larger, const Eigen::Vector3d& x);

/// The least radius of curvature [mm], about.
[[nodiscard]] double least_radius(const WrapShape& shape);

/// The point of the surface that is closest to one near it.
[[nodiscard]] Eigen::Vector3d closest_on(const WrapShape& shape,
                                         double larger,
                                         const Eigen::Vector3d& x);

/// Moves a point and a unit tangent along the geodesic through them by a length [mm].
void follow_geodesic(
    const WrapShape& shape, double larger, double length, Eigen::Vector3d& x, Eigen::Vector3d& t);

}  // namespace condyle::verification
