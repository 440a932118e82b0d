#include "condyle/elements/end_rates.h"

#include <Eigen/Geometry>

#include "condyle/math/rotation.h"

namespace condyle {

LineRates straight_end_rates(const LineEnds& ends) {
  const Eigen::Vector3d d = ends.x_D - ends.x_C;
  const double L = d.norm();
  const Eigen::Vector3d e = d / L;
  const Eigen::Matrix3d P = (Eigen::Matrix3d::Identity() - e * e.transpose()) / L;
  const Eigen::Matrix3d Q_P = skew(ends.q) * P;
  return {{-e, P, Q_P}, {e, -P, skew(e) - Q_P}};
}

bool end_rates(const LineElement& element,
               const RigidTransform& X_BA,
               const double* kept,
               LineRates& rates) {
  const LineEnds ends = ends_of(element, X_BA);
  if (element.path) return element.path->end_rates(ends, X_BA, kept, rates);
  if (!((ends.x_D - ends.x_C).norm() > kLeastLength)) return false;
  rates = straight_end_rates(ends);
  return true;
}

}  // namespace condyle
