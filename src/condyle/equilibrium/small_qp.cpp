#include "condyle/equilibrium/small_qp.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "condyle/math/decompositions.h"

namespace condyle {

Eigen::VectorXd solve_complementarity(const Eigen::MatrixXd& M, const Eigen::VectorXd& q) {
  const Eigen::Index n = q.size();
  std::vector<Eigen::Index> active;
  Eigen::VectorXd z = Eigen::VectorXd::Zero(n);
  const double small = 1e-12 * (1 + q.lpNorm<Eigen::Infinity>());
  for (int pivot = 0; pivot < 50 + 20 * n; ++pivot) {
    z.setZero();
    const Eigen::Index k = static_cast<Eigen::Index>(active.size());
    if (k > 0) {
      Eigen::MatrixXd sub(k, k);
      Eigen::VectorXd right(k);
      for (Eigen::Index i = 0; i < k; ++i) {
        right[i] = -q[active[i]];
        for (Eigen::Index j = 0; j < k; ++j) sub(i, j) = M(active[i], active[j]);
      }
      const Eigen::VectorXd solution = partially_pivoted_solution(sub, right);
      for (Eigen::Index i = 0; i < k; ++i) z[active[i]] = solution[i];
    }
    const Eigen::VectorXd w = M * z + q;
    // The least index that is infeasible, either way, changes side.
    Eigen::Index change = -1;
    for (Eigen::Index i = 0; i < n && change < 0; ++i) {
      const bool is_active = std::find(active.begin(), active.end(), i) != active.end();
      if (is_active ? z[i] < 0 : w[i] < -small) change = i;
    }
    if (change < 0) break;
    const auto found = std::find(active.begin(), active.end(), change);
    if (found != active.end()) {
      active.erase(found);
    } else {
      active.push_back(change);
    }
  }
  return z.cwiseMax(0);
}

SmallQpSolution solve_qp(const SmallQp& qp) {
  const Eigen::Index m = qp.C.rows(), n = qp.A.rows();
  SmallQpSolution solution;
  Eigen::Matrix<double, 6, 1> x0 = Eigen::Matrix<double, 6, 1>::Zero();
  SmallMatrix Z = SmallMatrix::Identity(6, 6);
  if (m > 0) {
    const LeastNormSolution at_C = least_norm_solution(qp.C, qp.b);
    x0 = at_C.x;
    const Eigen::MatrixXd Q = orthogonal_factor(qp.C.transpose());
    Z = Q.rightCols(6 - std::min<Eigen::Index>(at_C.rank, 6));
  }
  const Eigen::Index free = Z.cols();
  Eigen::VectorXd y = Eigen::VectorXd::Zero(free);
  solution.lambda = Eigen::VectorXd::Zero(n);
  if (free > 0) {
    const SymmetricEigenvalues eigen = symmetric_eigenvalues(Z.transpose() * qp.H * Z);
    const Eigen::VectorXd inverse = eigen.values.cwiseAbs().cwiseMax(qp.floor).cwiseInverse();
    const Eigen::MatrixXd W = eigen.vectors * inverse.asDiagonal() * eigen.vectors.transpose();
    const Eigen::VectorXd g = Z.transpose() * (qp.g + qp.H * x0);
    if (n > 0) {
      const Eigen::MatrixXd A = qp.A * Z;
      Eigen::MatrixXd M = A * W * A.transpose();
      M.diagonal().array() += qp.compliance * std::max(M.diagonal().maxCoeff(), 1e-300);
      const Eigen::VectorXd q = -(A * (W * g)) - (qp.d - qp.A * x0);
      solution.lambda = solve_complementarity(M, q);
      y = W * (A.transpose() * solution.lambda - g);
    } else {
      y = -W * g;
    }
  }
  solution.x = x0 + Z * y;
  solution.nu = Eigen::VectorXd::Zero(m);
  if (m > 0) {
    // H x + g = Aᵀ λ + Cᵀ ν in the least-squares sense.
    Eigen::VectorXd right = qp.H * solution.x + qp.g;
    if (n > 0) right -= qp.A.transpose() * solution.lambda;
    solution.nu = least_norm_solution(qp.C.transpose(), right).x;
  }
  return solution;
}

}  // namespace condyle
