#pragma once

/// Smooth surfaces that a line element wraps on, each in a frame of its own [mm]: the solid is
/// inside, the normal points out of it.

#include <Eigen/Core>

#include <variant>

namespace condyle {

/// Centre at the origin.
struct WrapSphere {
  double radius;
};

/// About the z axis, without ends.
struct WrapCylinder {
  double radius;
};

/// Centre at the origin, axes along x, y, z.
struct WrapEllipsoid {
  Eigen::Vector3d semi_axes;
};

/// About the z axis: the circle of radius `ring` in the plane z = 0 is the centre of the tube.
struct WrapTorus {
  double ring, tube;
};

using WrapShape = std::variant<WrapSphere, WrapCylinder, WrapEllipsoid, WrapTorus>;

}  // namespace condyle
