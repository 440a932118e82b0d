#include "condyle/math/rigid_transform.h"

namespace condyle {

// No inline functions: each of some 200 sources would instantiate them. What does so hundreds of times a pose writes
// R x + p itself.

Eigen::Vector3d RigidTransform::operator*(const Eigen::Vector3d& point) const {
  return R * point + p;
}

RigidTransform RigidTransform::operator*(const RigidTransform& other) const {
  return {R * other.R, R * other.p + p};
}

RigidTransform RigidTransform::inverse() const { return {R.transpose(), -(R.transpose() * p)}; }

}  // namespace condyle
