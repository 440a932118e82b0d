#pragma once

#include "condyle/math/degree.h"
#include "condyle/math/rigid_transform.h"
#include "support/random.h"

namespace condyle {

/// Turned by up to 16 degrees about x and 8 about y and z, and up to 8 mm away along each axis.
inline RigidTransform displaced(const RigidTransform& X, test::Random& random) {
  const Eigen::Vector3d turn(random.between(-16, 16), random.between(-8, 8), random.between(-8, 8));
  const Eigen::Vector3d way = random.vector(8);
  return {exp_rotation(kDegree * turn) * X.R, X.p + way};
}

}  // namespace condyle
