#include "condyle/calibration/least_squares.h"

#include <ceres/ceres.h>
#include <ceres/normal_prior.h>
#include <glog/logging.h>
#include <Eigen/QR>

#include <cassert>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

namespace condyle {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// f with f² = ρ(r²) and the sign of r, and df/dr: ½ Σ f² is the cost, its gradient exact. Huber's
/// ρ(r²) = r² within δ, 2 δ |r| - δ² beyond.
struct RobustResidual {
  double f, slope;
};
RobustResidual robust_residual(double r, const std::optional<double>& huber) {
  if (!huber || std::abs(r) <= *huber) return {r, 1};
  const double f = std::sqrt(*huber * (2 * std::abs(r) - *huber));
  return {std::copysign(f, r), *huber / f};
}

/// y, J and the cost at one θ.
struct Trial {
  VectorXd theta, y;
  MatrixXd J;
  double cost = std::numeric_limits<double>::infinity();
  bool exists = false;
};

/// The last θ that was asked for and the best: value and derivatives come with one solution of the
/// poses, however often Ceres asks.
class Trials {
 public:
  explicit Trials(const LeastSquaresProblem& problem) : problem_(problem) {}

  /// Holds until the next one.
  const Trial& at(const VectorXd& theta) {
    if (best_.exists && best_.theta == theta) return best_;
    if (last_.theta.size() > 0 && last_.theta == theta) return last_;
    last_.theta = theta;
    last_is_newest_ = true;
    last_.exists =
        problem_.evaluate(theta, last_.y, &last_.J) && last_.y.allFinite() && last_.J.allFinite();
    if (!last_.exists) {
      ++refused_;
      return last_;
    }
    last_.cost = cost(last_);
    if (best_.exists && !(last_.cost < best_.cost)) return last_;
    std::swap(best_, last_);
    last_is_newest_ = false;
    return best_;
  }
  [[nodiscard]] const Trial& best() const { return best_; }
  /// The last step led to predictions that are no better.
  [[nodiscard]] bool ended_above() const { return last_.exists && last_is_newest_; }
  [[nodiscard]] int refused() const { return refused_; }

 private:
  [[nodiscard]] double cost(const Trial& trial) const {
    double sum = 0;
    for (Eigen::Index i = 0; i < trial.y.size(); ++i) {
      const double r = (trial.y[i] - problem_.d[i]) / problem_.sd[i];
      sum += std::pow(robust_residual(r, problem_.huber).f, 2);
    }
    const VectorXd from_prior = trial.theta - problem_.prior_mean;
    return 0.5 * (sum + from_prior.cwiseQuotient(problem_.prior_sd).squaredNorm());
  }

  const LeastSquaresProblem& problem_;
  Trial last_, best_;
  bool last_is_newest_ = false;
  int refused_ = 0;
};

/// θ = scale z, scale a power of 2 next to the inverse of the column's norm at the start: the units of
/// the parameters drop out, and no bit is lost on the way.
VectorXd scale_of(const LeastSquaresProblem& problem, const MatrixXd& J) {
  const VectorXd squares =
      (problem.sd.cwiseInverse().asDiagonal() * J).colwise().squaredNorm().transpose() +
      problem.prior_sd.cwiseInverse().cwiseAbs2();
  return squares.unaryExpr(
      [](double s) { return s > 0 ? std::exp2(-std::round(0.5 * std::log2(s))) : 1; });
}

/// All rows of the table as one block over z.
class DataBlock : public ceres::CostFunction {
 public:
  DataBlock(const LeastSquaresProblem& problem, const VectorXd& scale, Trials& trials)
      : problem_(problem), scale_(scale), trials_(trials) {
    set_num_residuals(static_cast<int>(problem.d.size()));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(scale.size()));
  }

  bool Evaluate(double const* const* parameters,
                double* residuals,
                double** jacobians) const override {
    const VectorXd theta =
        scale_.cwiseProduct(Eigen::Map<const VectorXd>(parameters[0], scale_.size()));
    const Trial& trial = trials_.at(theta);
    if (!trial.exists) return false;
    const Eigen::Index rows = trial.y.size();
    const bool wants_rates = jacobians != nullptr && jacobians[0] != nullptr;
    Eigen::Map<RowMajor> rates(wants_rates ? jacobians[0] : nullptr, wants_rates ? rows : 0,
                               scale_.size());
    for (Eigen::Index i = 0; i < rows; ++i) {
      const double sd = problem_.sd[i];
      const RobustResidual r = robust_residual((trial.y[i] - problem_.d[i]) / sd, problem_.huber);
      residuals[i] = r.f;
      if (wants_rates)
        rates.row(i) = (r.slope / sd) * trial.J.row(i).cwiseProduct(scale_.transpose());
    }
    return true;
  }

 private:
  const LeastSquaresProblem& problem_;
  const VectorXd& scale_;
  Trials& trials_;
};

/// (θ - mean)/sd of the parameters that have a prior.
std::unique_ptr<ceres::CostFunction> prior_block(const LeastSquaresProblem& problem,
                                                 const VectorXd& scale) {
  const VectorXd precision = scale.cwiseQuotient(problem.prior_sd);
  if (precision.isZero(0)) return nullptr;
  return std::make_unique<ceres::NormalPrior>(MatrixXd(precision.asDiagonal()),
                                              problem.prior_mean.cwiseQuotient(scale));
}

/// Tells of accepted steps.
class Steps : public ceres::IterationCallback {
 public:
  Steps(const LeastSquaresOptions& options, const Trials& trials)
      : options_(options), trials_(trials) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& at) override {
    if (at.iteration == 0 || !at.step_is_successful) return ceres::SOLVER_CONTINUE;
    ++accepted;
    const bool goes_on =
        !options_.on_step || options_.on_step(accepted, trials_.best().cost, trials_.best().theta);
    return goes_on ? ceres::SOLVER_CONTINUE : ceres::SOLVER_TERMINATE_SUCCESSFULLY;
  }

  int accepted = 0;

 private:
  const LeastSquaresOptions& options_;
  const Trials& trials_;
};

ceres::Solver::Options ceres_options(const LeastSquaresOptions& options,
                                     double start_gradient,
                                     Steps& steps) {
  ceres::Solver::Options how;
  how.linear_solver_type = ceres::DENSE_QR;
  how.max_num_iterations = options.most_iterations;
  how.function_tolerance = options.tolerance;
  how.parameter_tolerance = options.tolerance;
  how.gradient_tolerance = 1e-14 * start_gradient;
  how.line_search_interpolation_type = ceres::QUADRATIC;
  how.jacobi_scaling = false;  // z is scaled
  how.logging_type = ceres::SILENT;
  how.num_threads = 1;
  how.callbacks.push_back(&steps);
  return how;
}

/// All rows over z at a trial, those of the prior last.
struct WeightedRows {
  VectorXd f;
  MatrixXd J;
};
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

/// What a whole step of Gauss and Newton would take off the cost, were the rows linear: 0 at a least. A
/// parameter that its gradient holds at a bound stays there.
double cost_left(const LeastSquaresProblem& problem, const Trial& at, const VectorXd& scale) {
  WeightedRows rows = weighted_rows(problem, at, scale);
  const VectorXd gradient = rows.J.transpose() * rows.f;
  for (Eigen::Index j = 0; j < gradient.size(); ++j)
    if ((at.theta[j] <= problem.lower[j] && gradient[j] > 0) ||
        (at.theta[j] >= problem.upper[j] && gradient[j] < 0))
      rows.J.col(j).setZero();
  const Eigen::ColPivHouseholderQR<MatrixXd> qr(rows.J);
  const VectorXd along = qr.householderQ().adjoint() * rows.f;
  return 0.5 * along.head(qr.rank()).squaredNorm();
}

/// Steps that were cut short for want of predictions end in small changes of the cost, too.
bool is_least(const LeastSquaresProblem& problem,
              const LeastSquaresOptions& options,
              const Trial& at,
              const VectorXd& scale) {
  constexpr double kNothing = 1e-8;  // of ½ χ²: θ is within 1.4e-4 posterior sd
  return cost_left(problem, at, scale) <= kNothing + 100 * options.tolerance * at.cost;
}

void set_bounds(const LeastSquaresProblem& problem,
                const VectorXd& scale,
                double* z,
                ceres::Problem& to) {
  constexpr double kNone = 1e300;
  for (Eigen::Index j = 0; j < scale.size(); ++j) {
    if (problem.lower[j] > -kNone)
      to.SetParameterLowerBound(z, static_cast<int>(j), problem.lower[j] / scale[j]);
    if (problem.upper[j] < kNone)
      to.SetParameterUpperBound(z, static_cast<int>(j), problem.upper[j] / scale[j]);
  }
}

/// Ceres says nothing by itself: its logger starts with stderr open.
void silence_the_logger() {
  static const bool done = [] {
    FLAGS_minloglevel = google::GLOG_FATAL;
    return true;
  }();
  static_cast<void>(done);
}

/// From the best trial so far; the result gets all but the numbers at the least.
void minimise(const LeastSquaresProblem& problem,
              const LeastSquaresOptions& options,
              Trials& trials,
              LeastSquaresResult& result) {
  const VectorXd scale = scale_of(problem, trials.best().J);
  VectorXd z = trials.best().theta.cwiseQuotient(scale);
  ceres::Problem sum;
  sum.AddResidualBlock(new DataBlock(problem, scale, trials), nullptr, z.data());
  if (auto prior = prior_block(problem, scale))
    sum.AddResidualBlock(prior.release(), nullptr, z.data());
  set_bounds(problem, scale, z.data(), sum);

  Steps steps(options, trials);
  ceres::Solver::Summary summary;
  const WeightedRows start = weighted_rows(problem, trials.best(), scale);
  const double gradient = (start.J.transpose() * start.f).lpNorm<Eigen::Infinity>();
  ceres::Solve(ceres_options(options, gradient, steps), &sum, &summary);
  result.iterations = steps.accepted;
  result.stopped = summary.termination_type == ceres::USER_SUCCESS;
  result.message = summary.message;
  if (summary.termination_type != ceres::CONVERGENCE) return;
  result.converged = is_least(problem, options, trials.best(), scale);
  if (result.converged) return;
  result.converged = trials.refused() == 0 || trials.ended_above();
  result.message = result.converged
                       ? "least at a kink: in some pose a contact is about to open or close"
                       : "the cost falls on, where there are no predictions";
}

}  // namespace

LeastSquaresResult solve_least_squares(const LeastSquaresProblem& problem,
                                       const VectorXd& start,
                                       const LeastSquaresOptions& options) {
  assert((start.array() >= problem.lower.array()).all() &&
         (start.array() <= problem.upper.array()).all());
  const auto begin = std::chrono::steady_clock::now();
  silence_the_logger();
  LeastSquaresResult result;
  Trials trials(problem);
  if (trials.at(start).exists)
    minimise(problem, options, trials, result);
  else
    result.message = "no predictions at the start";
  const Trial& best = trials.best();
  result.theta = best.exists ? best.theta : start;
  result.y = best.y;
  result.J = best.J;
  result.cost = best.cost;
  if (best.exists) result.chi_square = (best.y - problem.d).cwiseQuotient(problem.sd).squaredNorm();
  result.refused = trials.refused();
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

}  // namespace condyle
