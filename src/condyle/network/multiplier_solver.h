#pragma once

/// Multipliers of constraints: C μ = r, C = J P⁻¹ Jᵀ of a few rows, each scaled to one. Where rows
/// depend on each other they share their load.

#include <Eigen/Core>

namespace condyle {

class MultiplierSolver {
 public:
  void factor(const Eigen::MatrixXd& compliance);
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& right_side) const;

 private:
  [[nodiscard]] bool factor_scaled();

  Eigen::VectorXd scale_;
  Eigen::MatrixXd scaled_, cholesky_;  ///< lower triangle, its diagonal inverted
  bool independent_ = true;
};

}  // namespace condyle
