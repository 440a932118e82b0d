#include "condyle/calibration/multi_start.h"

#include <algorithm>
#include <cmath>

#include "condyle/design/normal_draws.h"

namespace condyle {
namespace {

/// A θ without a prior starts where the scene has it.
Eigen::VectorXd drawn_start(const LeastSquaresProblem& rows, unsigned seed, int number) {
  Eigen::VectorXd theta = normal_draws(seed, DrawsFor::kStart, static_cast<std::uint64_t>(number),
                                       rows.prior_sd.size());
  for (Eigen::Index j = 0; j < theta.size(); ++j)
    theta[j] = has_prior(rows.prior_sd[j]) ? theta[j] * rows.prior_sd[j] : 0;
  return theta.cwiseMax(rows.lower).cwiseMin(rows.upper);
}

}  // namespace

std::vector<LeastSquaresResult> fit_from_prior(
    const FitProblem& problem,
    int count,
    unsigned seed,
    const std::function<void(const Eigen::VectorXd& theta, double cost)>& on_better,
    StudyProgress& progress) {
  std::vector<LeastSquaresResult> fits(static_cast<std::size_t>(std::max(0, count - 1)));
  std::mutex one_at_a_time;
  LeastSquaresOptions options;
  options.on_step = [&](int, double cost, const Eigen::VectorXd& theta) {
    const std::lock_guard lock(one_at_a_time);
    if (on_better) on_better(theta, cost);
    return true;
  };
  const auto make_task = [&] {
    return [&, worker = problem.make_worker()](int k) {
      const Eigen::VectorXd start = nearest_start(worker, drawn_start(problem.rows, seed, k + 1));
      LeastSquaresResult& fit = fits[static_cast<std::size_t>(k)];
      fit = fit_by(worker, problem.rows, start, progress, options);
      options.on_step(fit.iterations, fit.cost, fit.theta);  // the last trial may be the best
    };
  };
  in_parallel("starts", static_cast<int>(fits.size()), problem.threads, make_task, progress);
  return fits;
}

}  // namespace condyle
