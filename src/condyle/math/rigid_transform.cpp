#include "condyle/math/rigid_transform.h"

namespace condyle {

// No inline functions: each of some 200 sources would instantiate them.

RigidTransform RigidTransform::operator*(const RigidTransform& other) const {
  return {R * other.R, R * other.p + p};
}

RigidTransform RigidTransform::inverse() const { return {R.transpose(), -(R.transpose() * p)}; }

}  // namespace condyle
