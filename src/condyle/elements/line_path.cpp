#include "condyle/elements/line_path.h"

#include <Eigen/Geometry>

#include "condyle/math/rotation.h"

namespace condyle {

// x_D moves by da + dπ x q, so that de = H (da + dπ x q) and dq = dπ x q.
Wrench pull_at_moving_end(const Eigen::Vector3d& e,
                          const Eigen::Matrix3d& H,
                          const Eigen::Vector3d& q) {
  Wrench unit;
  const Eigen::Matrix3d Q = skew(q);
  unit.f = -e;
  unit.m = q.cross(unit.f);
  unit.F1 = -H;
  unit.F2.noalias() = H * Q;
  unit.M1 = unit.F2.transpose();
  unit.M2 = q * unit.f.transpose() + Q * unit.F2;
  unit.M2.diagonal().array() -= q.dot(unit.f);
  return unit;
}

// In the frame of A, C moves by -(da + dπ x c), and what is told in the ground frame turns by dπ:
// de = H (da + dπ x c) + dπ x e, while the line of the pull goes through C, which stays.
Wrench pull_at_fixed_end(const Eigen::Vector3d& e,
                         const Eigen::Matrix3d& H,
                         const Eigen::Vector3d& c) {
  Wrench unit;
  const Eigen::Matrix3d Q = skew(c);
  unit.f = -e;
  unit.m = c.cross(unit.f);
  unit.F1 = -H;
  unit.F2 = skew(e) + H * Q;
  unit.M1 = unit.F2.transpose();
  unit.M2.noalias() = Q * unit.F2;
  return unit;
}

}  // namespace condyle
