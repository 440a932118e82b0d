#pragma once

/// Fits from starts drawn from the prior: whether there is another least.

#include "condyle/calibration/fit_problem.h"

namespace condyle {

/// Starts 1 to count - 1 (0 is the scene's own, fitted before), each drawn from the prior of `seed` and
/// its number, cut to the bounds, and halved towards the scene where its poses are lost. Those that were
/// not begun when `progress` said stop have no θ. `on_better` is told of steps, one thread at a time.
[[nodiscard]] std::vector<LeastSquaresResult> fit_from_prior(
    const FitProblem& problem,
    int count,
    unsigned seed,
    const std::function<void(const Eigen::VectorXd& theta, double cost)>& on_better,
    StudyProgress& progress);

}  // namespace condyle
