#include "condyle/network/multiplier_solver.h"

#include <cmath>

#include "condyle/math/decompositions.h"

namespace condyle {

void MultiplierSolver::factor(const Eigen::MatrixXd& compliance) {
  const Eigen::Index n = compliance.rows();
  scale_.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) scale_[i] = 1 / std::sqrt(compliance(i, i));
  scaled_.resize(n, n);
  for (Eigen::Index j = 0; j < n; ++j)
    for (Eigen::Index i = 0; i < n; ++i) scaled_(i, j) = scale_[i] * compliance(i, j) * scale_[j];
  independent_ = factor_scaled();
}

/// Cholesky by columns: for so few rows a library's blocks cost more than they save.
bool MultiplierSolver::factor_scaled() {
  constexpr double kNearlyDependent = 1e-5;
  const Eigen::Index n = scaled_.rows();
  cholesky_.resize(n, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    for (Eigen::Index i = j; i < n; ++i) {
      double sum = scaled_(i, j);
      for (Eigen::Index k = 0; k < j; ++k) sum -= cholesky_(i, k) * cholesky_(j, k);
      cholesky_(i, j) = sum;
    }
    if (!(cholesky_(j, j) > kNearlyDependent * kNearlyDependent)) return false;
    cholesky_(j, j) = 1 / std::sqrt(cholesky_(j, j));
    for (Eigen::Index i = j + 1; i < n; ++i) cholesky_(i, j) *= cholesky_(j, j);
  }
  return true;
}

Eigen::VectorXd MultiplierSolver::solve(const Eigen::VectorXd& right_side) const {
  const Eigen::Index n = right_side.size();
  Eigen::VectorXd x(n);
  for (Eigen::Index i = 0; i < n; ++i) x[i] = scale_[i] * right_side[i];
  if (!independent_) return scale_.cwiseProduct(least_norm_solution(scaled_, x, 1e-11).x);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index k = 0; k < i; ++k) x[i] -= cholesky_(i, k) * x[k];
    x[i] *= cholesky_(i, i);
  }
  for (Eigen::Index i = n; i-- > 0;) {
    for (Eigen::Index k = i + 1; k < n; ++k) x[i] -= cholesky_(k, i) * x[k];
    x[i] *= cholesky_(i, i);
  }
  for (Eigen::Index i = 0; i < n; ++i) x[i] *= scale_[i];
  return x;
}

}  // namespace condyle
