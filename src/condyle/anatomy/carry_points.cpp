#include "condyle/anatomy/carry_points.h"

namespace condyle {

CarriedPoints carry_points(const FramedBone& from,
                           const FramedBone& to,
                           const std::vector<Eigen::Vector3d>& points) {
  CarriedPoints carried;
  for (const Eigen::Vector3d& p : points) {
    const Eigen::Vector3d c = from.frame.components(p - from.frame.origin);
    carried.points.push_back({to.frame.origin + to.frame.anterior * c.x() +
                              to.frame.proximal * c.y() + to.frame.lateral * c.z()});
  }
  return carried;
}

}  // namespace condyle
