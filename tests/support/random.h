#pragma once

/// Random vectors and poses that are the same in every run.

#include <Eigen/Core>

#include <random>

#include "condyle/math/rigid_transform.h"
#include "condyle/math/rotation.h"

namespace condyle::test {

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}

  [[nodiscard]] double between(double low, double high) {
    return low +
           (high - low) * static_cast<double>(engine_()) / static_cast<double>(std::mt19937::max());
  }
  /// Each component within ±size.
  [[nodiscard]] Eigen::Vector3d vector(double size) {
    const double x = between(-size, size), y = between(-size, size), z = between(-size, size);
    return {x, y, z};
  }
  [[nodiscard]] Eigen::Vector3d direction() {
    for (;;) {
      const Eigen::Vector3d v = vector(1);
      if (v.norm() > 0.1 && v.norm() < 1) return v.normalized();
    }
  }
  [[nodiscard]] Eigen::Matrix3d rotation() { return exp_rotation(between(0, 3) * direction()); }
  [[nodiscard]] RigidTransform pose(double size) {
    const Eigen::Matrix3d R = rotation();
    return {R, vector(size)};
  }

 private:
  std::mt19937 engine_;
};

}  // namespace condyle::test
