#pragma once

/// How length and pull of a line element change as one of its ends moves on its own body while the
/// pose stays. With v the motion of that end in the ground frame, of a straight element (e, q, L as in
/// line_element.h, P = (I - e eᵀ)/L)
///     end C:  dL = -e.v   df =  P v   dm = q x P v
///     end D:  dL =  e.v   df = -P v   dm = e x v - q x P v
/// where f = -e, m = q x f is the wrench of 1 N on A about O_A.

#include "condyle/elements/line_element.h"

namespace condyle {

struct LineEndRates {
  Eigen::Vector3d length = Eigen::Vector3d::Zero();  ///< ∂L/∂v
  Eigen::Matrix3d f = Eigen::Matrix3d::Zero();       ///< ∂f/∂v [1/mm]
  Eigen::Matrix3d m = Eigen::Matrix3d::Zero();       ///< ∂m/∂v, about O_A
};

struct LineRates {
  LineEndRates of_C, of_D;
};

/// Of a straight line from x_C to x_D at the arm q of D.
[[nodiscard]] LineRates straight_end_rates(const LineEnds& ends);

/// False where the element has no length, or a path that does not know.
bool end_rates(const LineElement& element,
               const RigidTransform& X_BA,
               const double* kept,
               LineRates& rates);

}  // namespace condyle
