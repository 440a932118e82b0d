#include "condyle/equilibrium/admissible_motions.h"

#include <algorithm>

#include "condyle/math/decompositions.h"

namespace condyle {
namespace {

constexpr double kDependent = 1e-9;  // of constraint directions

}  // namespace

Eigen::Matrix<double, 6, 1> constraint_direction(const Linearization& at, std::size_t constraint) {
  Eigen::Matrix<double, 6, 1> direction;
  const std::size_t n = at.contacts().size();
  if (constraint < n) {
    const ContactLinearization& contact = at.contacts()[constraint];
    direction << contact.B.n, contact.arm / at.model.length;
  } else {
    const ConditionDerivatives& condition = at.conditions()[constraint - n];
    direction << condition.alpha, condition.eta / at.model.length;
  }
  // Conditions on lengths and on angles differ in size: only their directions matter.
  return direction.normalized();
}

Motions admissible_motions(const Linearization& at) {
  const std::size_t count = std::min<std::size_t>(at.constraints(), kMaxConstraints);
  SmallMatrix columns(6, static_cast<Eigen::Index>(count));
  for (std::size_t k = 0; k < count; ++k)
    columns.col(static_cast<Eigen::Index>(k)) = constraint_direction(at, k);
  if (count == 0 || !columns.allFinite()) return SmallMatrix::Identity(6, 6);
  const PivotedBasis basis = pivoted_basis(columns, kDependent);
  return basis.Q.rightCols(6 - basis.rank);
}

}  // namespace condyle
