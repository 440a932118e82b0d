#include "condyle/math/rigid_transform.h"

namespace condyle {

Eigen::Vector3d RigidTransform::operator*(const Eigen::Vector3d& point) const {
  return R * point + p;
}

RigidTransform RigidTransform::operator*(const RigidTransform& other) const {
  return {R * other.R, R * other.p + p};
}

RigidTransform RigidTransform::inverse() const { return {R.transpose(), -(R.transpose() * p)}; }

}  // namespace condyle
