/// What puts a network's state back on its constraints, and impulses.

#include "condyle/network/network_equations.h"

namespace condyle {

Eigen::VectorXd NetworkEquations::rates() const { return J_ * at_.twists(); }

/// J x as it is to be, x the twists of the bodies.
Eigen::VectorXd NetworkEquations::prescribed_rates() const {
  Eigen::VectorXd after(J_.rows());
  for (Eigen::Index k = 0; k < J_.rows(); ++k) {
    const ConstraintRow& row = rows_[static_cast<std::size_t>(k)];
    after[k] = row.rate;
    if (graph_.vertices[row.vertex_from].body == kNoBody)
      after[k] += row.direction.dot(at_.vertex_twist(row.vertex_from));
    if (graph_.vertices[row.vertex_to].body == kNoBody)
      after[k] -= row.direction.dot(at_.vertex_twist(row.vertex_to));
  }
  return after;
}

/// What J x changes by where the bodies are moved.
Eigen::VectorXd NetworkEquations::turned(const Eigen::VectorXd& moved) const {
  Eigen::VectorXd change = Eigen::VectorXd::Zero(J_.rows());
  for (Eigen::Index k = 0; k < J_.rows(); ++k) {
    const ConstraintRow& row = rows_[static_cast<std::size_t>(k)];
    const int to = graph_.vertices[row.vertex_to].body,
              from = graph_.vertices[row.vertex_from].body;
    if (to >= 0) change[k] += row.turn_to.dot(moved.segment<6>(6 * to));
    if (from >= 0) change[k] += row.turn_from.dot(moved.segment<6>(6 * from));
  }
  return change;
}

Eigen::VectorXd NetworkEquations::position_correction() const {
  return position_correction_after(Eigen::VectorXd::Zero(J_.cols()));
}

Eigen::VectorXd NetworkEquations::velocity_correction() const {
  Eigen::VectorXd unused;
  return impact(prescribed_rates(), unused);
}

Eigen::VectorXd NetworkEquations::position_correction_after(const Eigen::VectorXd& moved) const {
  Eigen::VectorXd value = J_.lazyProduct(moved);
  for (Eigen::Index k = 0; k < J_.rows(); ++k) value[k] += rows_[static_cast<std::size_t>(k)].value;
  return -J_weighted_.lazyProduct(solver_.solve(value));
}

Eigen::VectorXd NetworkEquations::velocity_correction_after(const Eigen::VectorXd& moved,
                                                            const Eigen::VectorXd& twists) const {
  const Eigen::VectorXd excess = J_.lazyProduct(twists) + turned(moved) - prescribed_rates();
  return -J_weighted_.lazyProduct(solver_.solve(excess));
}

void NetworkEquations::keep_admissible(Eigen::VectorXd& motion, Eigen::VectorXd& change) const {
  motion -= J_weighted_.lazyProduct(solver_.solve(J_.lazyProduct(motion)));
  change -= J_weighted_.lazyProduct(solver_.solve(J_.lazyProduct(change) + turned(motion)));
}

Eigen::VectorXd NetworkEquations::impact(const Eigen::VectorXd& after,
                                         Eigen::VectorXd& impulse) const {
  impulse = solver_.solve(rates() - after);
  return -J_weighted_ * impulse;
}

}  // namespace condyle
