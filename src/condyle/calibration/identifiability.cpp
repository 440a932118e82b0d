#include "condyle/calibration/identifiability.h"

#include <cassert>
#include <cmath>

#include "condyle/math/decompositions.h"

namespace condyle {
namespace {

std::vector<Eigen::Index> free_ones(const std::vector<bool>& fixed, Eigen::Index n) {
  std::vector<Eigen::Index> free;
  for (Eigen::Index j = 0; j < n; ++j)
    if (!fixed[static_cast<std::size_t>(j)]) free.push_back(j);
  return free;
}

}  // namespace

Identifiability identifiability(const Eigen::MatrixXd& J,
                                const Eigen::VectorXd& weight,
                                const Eigen::VectorXd& prior_sd,
                                const std::vector<bool>& fixed) {
  const Eigen::Index n = J.cols();
  assert(weight.size() == J.rows() && prior_sd.size() == n &&
         fixed.size() == static_cast<std::size_t>(n) && prior_sd.allFinite());
  const std::vector<Eigen::Index> free = free_ones(fixed, n);
  const auto k = static_cast<Eigen::Index>(free.size());
  const Eigen::VectorXd p = prior_sd(free);
  const Eigen::MatrixXd S = weight.asDiagonal() * J(Eigen::all, free) * p.asDiagonal();

  Identifiability result;
  result.singular_values = Eigen::VectorXd::Zero(n);
  result.directions = Eigen::MatrixXd::Zero(n, n);
  result.covariance = Eigen::MatrixXd::Zero(n, n);
  Eigen::Index column = k;
  for (Eigen::Index j = 0; j < n; ++j)
    if (fixed[static_cast<std::size_t>(j)]) result.directions(j, column++) = 1;
  if (k > 0) {
    Eigen::MatrixXd V = Eigen::MatrixXd::Identity(k, k);
    if (S.rows() > 0) {
      const SingularValues svd = singular_values(S);
      result.singular_values.head(svd.values.size()) = svd.values;
      V = svd.V;
    }
    result.directions(free, Eigen::seqN(0, k)) = V;
    // (SᵀS + I)⁻¹ = V (Σ² + I)⁻¹ Vᵀ
    const Eigen::VectorXd shrunk =
        (1 + result.singular_values.head(k).array().square()).rsqrt().matrix();
    const Eigen::MatrixXd root = p.asDiagonal() * V * shrunk.asDiagonal();
    result.covariance(free, free) = root * root.transpose();
  }
  const Eigen::ArrayXd squares = result.singular_values.array().square();
  result.determined = static_cast<int>((result.singular_values.array() > 1).count());
  result.effective = (squares / (1 + squares)).sum();
  result.sd = result.covariance.diagonal().cwiseSqrt();
  return result;
}

Information information_of(const Eigen::MatrixXd& J,
                           const Eigen::VectorXd& weight,
                           const Eigen::MatrixXd& covariance) {
  // det(I + C JᵀW²J) = det(I + W J C JᵀW), as large as there are rows.
  const Eigen::MatrixXd WJ = weight.asDiagonal() * J;
  const Eigen::MatrixXd WJC = WJ * covariance;
  const Eigen::MatrixXd small =
      Eigen::MatrixXd::Identity(J.rows(), J.rows()) + WJC * WJ.transpose();
  const Eigen::MatrixXd root = lower_root(small), gain = lower_solution(root, WJC);
  return {root.diagonal().array().log().sum(), covariance - gain.transpose() * gain};
}

}  // namespace condyle
