#include "condyle/equilibrium/stability.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "condyle/equilibrium/dependence.h"
#include "condyle/equilibrium/motion_name.h"
#include "condyle/math/decompositions.h"

namespace condyle {
namespace {

constexpr double kNeutral = 1e-9;  // of the largest stiffness

}  // namespace

Stability stability(const Linearization& at) {
  Eigen::Matrix<double, 6, 6> K = scaled_stiffness(at.wrench(), at.model.length);
  K = (0.5 * (K + K.transpose())).eval();
  const double largest = std::max(K.cwiseAbs().maxCoeff(), at.force_scale() / at.model.length);

  Stability result{std::numeric_limits<double>::infinity(), Eigen::Matrix<double, 6, 1>::Zero(),
                   false, false, Motions(6, 0)};
  const SmallMatrix Z = admissible_motions(at);
  result.dependent = static_cast<std::size_t>(6 - Z.cols()) < at.constraints();
  const SmallMatrix reduced = Z.transpose() * K * Z;
  if (Z.cols() == 0 || !reduced.allFinite()) return result;
  const SymmetricEigenvalues eigen = symmetric_eigenvalues(reduced);
  result.lowest_stiffness = eigen.values[0];
  result.motion = Z * eigen.vectors.col(0);
  result.neutral = std::abs(result.lowest_stiffness) <= kNeutral * largest;
  if (!result.neutral) return result;
  Eigen::Index free = 0;
  while (free < Z.cols() && eigen.values[free] <= kNeutral * largest) ++free;
  result.free = Z * eigen.vectors.leftCols(free);
  return result;
}

std::string stability_remark(const Linearization& at, const Stability& stability) {
  std::string remark;
  if (stability.neutral) {
    remark = "neutral: nothing resists " + name_motions(at.model, at.state.X, stability.free);
  } else if (!stability.stable()) {
    remark = "unstable along " + name_motions(at.model, at.state.X, stability.motion);
  }
  if (!stability.dependent) return remark;
  if (!remark.empty()) remark += "; ";
  return remark + dependent_constraints(at) + ": what each carries is not determined";
}

}  // namespace condyle
