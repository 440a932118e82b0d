#include "condyle/calibration/least_squares.h"

#include <ceres/ceres.h>
#include <ceres/normal_prior.h>
#include <glog/logging.h>

#include <cassert>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "condyle/calibration/kinked_least.h"

namespace condyle {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

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
    return fell() ? ceres::SOLVER_CONTINUE : ceres::SOLVER_TERMINATE_SUCCESSFULLY;
  }

  /// A step was accepted; false: stop.
  bool fell() {
    ++accepted;
    return !options_.on_step ||
           options_.on_step(accepted, trials_.best().cost, trials_.best().theta);
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

/// From the best trial so far, by Ceres.
ceres::Solver::Summary go_down(const LeastSquaresProblem& problem,
                               const LeastSquaresOptions& options,
                               const VectorXd& scale,
                               Steps& steps,
                               Trials& trials) {
  VectorXd z = trials.best().theta.cwiseQuotient(scale);
  ceres::Problem sum;
  sum.AddResidualBlock(new DataBlock(problem, scale, trials), nullptr, z.data());
  if (auto prior = prior_block(problem, scale))
    sum.AddResidualBlock(prior.release(), nullptr, z.data());
  set_bounds(problem, scale, z.data(), sum);
  ceres::Solver::Summary summary;
  const WeightedRows start = weighted_rows(problem, trials.best(), scale);
  const double gradient = (start.J.transpose() * start.f).lpNorm<Eigen::Infinity>();
  ceres::Solve(ceres_options(options, gradient, steps), &sum, &summary);
  return summary;
}

/// Steps that are cut short for want of predictions, or by kinks, end in small changes of the cost, too.
/// Where kinks are in the way, that is along them, and goes on from there.
void minimise(const LeastSquaresProblem& problem,
              const LeastSquaresOptions& options,
              Trials& trials,
              LeastSquaresResult& result) {
  constexpr int kRounds = 3;
  const VectorXd scale = scale_of(problem, trials.best().J);
  Steps steps(options, trials);
  for (int round = 0; round < kRounds && !result.converged; ++round) {
    const ceres::Solver::Summary summary = go_down(problem, options, scale, steps, trials);
    result.message = summary.message;
    result.stopped = summary.termination_type == ceres::USER_SUCCESS;
    if (result.stopped || summary.termination_type == ceres::FAILURE) break;
    const Trial& best = trials.best();
    const double cost = best.cost;
    result.converged = cost_left(problem, best, scale) <= negligible_cost(options, cost);
    if (result.converged) break;
    result.message = trials.refused() > 0 ? "the cost falls on, where there are no predictions"
                                          : "the cost falls on, by less than it is known";
    const KinkedLeast kinked =
        descend_along_kinks(problem, options, scale, trials, [&steps] { return steps.fell(); });
    result.stopped = kinked.stopped;
    result.converged = kinked.found && !kinked.rows.empty();
    result.one_sided = kinked.rows;
    if (result.converged)
      result.message = "least at a kink: in some pose a contact is about to open or close";
    if (result.stopped || !(trials.best().cost < cost)) break;
  }
  result.iterations = steps.accepted;
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
