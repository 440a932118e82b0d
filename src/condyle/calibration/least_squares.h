#pragma once

/// Maximum a posteriori estimate θ: least of
///     ½ Σ_i ρ(((y_i(θ) - d_i)/sd_i)²) + ½ Σ_j (θ_j/prior_j)²
/// within bounds, ρ(s) = s or Huber's. By Ceres (trust region of Levenberg and Marquardt) with the
/// derivatives of the predictions. A θ at which y does not exist shortens the step. Where the slope of y
/// jumps, as where a contact opens, the least may lie at the kink (kinked_least.h).

#include "condyle/calibration/least_squares_problem.h"

namespace condyle {

/// `start` within the bounds, where y exists; converged is false where it does not.
[[nodiscard]] LeastSquaresResult solve_least_squares(const LeastSquaresProblem& problem,
                                                     const Eigen::VectorXd& start,
                                                     const LeastSquaresOptions& options = {});

}  // namespace condyle
