#pragma once

/// External loads on the moving body A [Dortmans 1986, App. E]: dead (fixed in the ground frame) or
/// follower (fixed in the body) force at a point of A, or moment; or any load f(a,R), m(a,R) with
/// its derivatives.

#include <functional>

#include "condyle/elements/wrench.h"
#include "condyle/math/rigid_transform.h"

namespace condyle {

struct Load {
  bool moment = false;
  bool follows_body = false;
  Eigen::Vector3d vector =
      Eigen::Vector3d::Zero();  ///< [N] or [N mm]; ground frame, or A's frame for a follower
  Eigen::Vector3d at =
      Eigen::Vector3d::Zero();  ///< point of application in A's frame [mm]; forces only
  double scale = 1;             ///< that multiplies the vector, nominally
  /// In place of all the above but the scale: writes the wrench on A about O_A and its derivatives
  /// at the pose.
  std::function<void(const RigidTransform& X_BA, Wrench& wrench)> custom;
};

/// Adds `scale` times the load and its derivatives to `wrench`. Allocates nothing.
void add_load(const Load& load, double scale, const RigidTransform& X_BA, Wrench& wrench);

}  // namespace condyle
