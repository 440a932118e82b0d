#include "condyle/calibration/weighted_rows.h"

#include <cmath>
#include <utility>

#include "condyle/math/decompositions.h"

namespace condyle {

using Eigen::MatrixXd;
using Eigen::VectorXd;

RobustResidual robust_residual(double r, const std::optional<double>& huber) {
  if (!huber || std::abs(r) <= *huber) return {r, 1};
  const double f = std::sqrt(*huber * (2 * std::abs(r) - *huber));
  return {std::copysign(f, r), *huber / f};
}

const Trial& Trials::at(const VectorXd& theta) {
  if (best_.exists && best_.theta == theta) return best_;
  if (last_.theta.size() > 0 && last_.theta == theta) return last_;
  last_.theta = theta;
  last_.exists =
      problem_.evaluate(theta, last_.y, &last_.J) && last_.y.allFinite() && last_.J.allFinite();
  if (!last_.exists) {
    ++refused_;
    return last_;
  }
  last_.cost = cost(last_);
  if (best_.exists && !(last_.cost < best_.cost)) return last_;
  std::swap(best_, last_);
  return best_;
}

double Trials::cost(const Trial& trial) const {
  double sum = 0;
  for (Eigen::Index i = 0; i < trial.y.size(); ++i) {
    const double r = (trial.y[i] - problem_.d[i]) / problem_.sd[i];
    sum += std::pow(robust_residual(r, problem_.huber).f, 2);
  }
  const VectorXd from_prior = trial.theta - problem_.prior_mean;
  return 0.5 * (sum + from_prior.cwiseQuotient(problem_.prior_sd).squaredNorm());
}

VectorXd scale_of(const LeastSquaresProblem& problem, const MatrixXd& J) {
  const VectorXd squares =
      (problem.sd.cwiseInverse().asDiagonal() * J).colwise().squaredNorm().transpose() +
      problem.prior_sd.cwiseInverse().cwiseAbs2();
  return squares.unaryExpr(
      [](double s) { return s > 0 ? std::exp2(-std::round(0.5 * std::log2(s))) : 1; });
}

WeightedRows weighted_rows(const LeastSquaresProblem& problem,
                           const Trial& at,
                           const VectorXd& scale) {
  const Eigen::Index m = at.y.size(), n = scale.size();
  WeightedRows rows{VectorXd(m + n), MatrixXd::Zero(m + n, n)};
  for (Eigen::Index i = 0; i < m; ++i) {
    const double sd = problem.sd[i];
    const RobustResidual r = robust_residual((at.y[i] - problem.d[i]) / sd, problem.huber);
    rows.f[i] = r.f;
    rows.J.row(i) = (r.slope / sd) * at.J.row(i).cwiseProduct(scale.transpose());
  }
  rows.f.tail(n) = (at.theta - problem.prior_mean).cwiseQuotient(problem.prior_sd);
  rows.J.bottomRows(n).diagonal() = scale.cwiseQuotient(problem.prior_sd);
  return rows;
}

double cost_left(const LeastSquaresProblem& problem, const Trial& at, const VectorXd& scale) {
  WeightedRows rows = weighted_rows(problem, at, scale);
  const VectorXd gradient = rows.J.transpose() * rows.f;
  for (Eigen::Index j = 0; j < gradient.size(); ++j)
    if ((at.theta[j] <= problem.lower[j] && gradient[j] > 0) ||
        (at.theta[j] >= problem.upper[j] && gradient[j] < 0))
      rows.J.col(j).setZero();
  return 0.5 * square_along(rows.J, rows.f);
}

double negligible_cost(const LeastSquaresOptions& options, double cost) {
  return 1e-8 + 100 * options.tolerance * cost;
}

}  // namespace condyle
