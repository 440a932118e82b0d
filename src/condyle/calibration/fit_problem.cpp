#include "condyle/calibration/fit_problem.h"

#include <algorithm>
#include <utility>

namespace condyle {

bool reach(const FitWorker& worker, const Eigen::VectorXd& theta) {
  worker.reset();
  Eigen::VectorXd y;
  double at = 0, step = 1;
  while (at < 1) {
    const double next = std::min(1., at + step);
    if (worker.evaluate(next * theta, y, nullptr)) {
      at = next;
      step *= 2;
    } else if ((step /= 2) < 1. / 64) {
      return false;
    }
  }
  return true;
}

Eigen::VectorXd nearest_start(const FitWorker& worker, const Eigen::VectorXd& theta) {
  Eigen::VectorXd y;
  double part = 1;
  for (int halvings = 0; halvings < 20; ++halvings, part /= 2) {
    worker.reset();
    if (worker.evaluate(part * theta, y, nullptr)) return part * theta;
  }
  worker.reset();
  return 0 * theta;
}

LeastSquaresResult fit_by(const FitWorker& worker,
                          LeastSquaresProblem rows,
                          const Eigen::VectorXd& start,
                          StudyProgress& progress,
                          LeastSquaresOptions options) {
  rows.evaluate = worker.evaluate;
  options.on_step = [&progress, told = std::move(options.on_step)](int iteration, double cost,
                                                                   const Eigen::VectorXd& theta) {
    const bool goes_on = !told || told(iteration, cost, theta);
    return progress.goes_on() && goes_on;
  };
  return solve_least_squares(rows, start, options);
}

}  // namespace condyle
