#pragma once

/// What is fitted, by as many threads as there are: rows and priors once, predictions for each thread.

#include <functional>
#include <optional>

#include "condyle/calibration/in_parallel.h"
#include "condyle/calibration/least_squares.h"

namespace condyle {

/// Predictions of one thread.
struct FitWorker {
  Evaluate evaluate;
  std::function<void()> reset;  ///< as at the scene's own numbers, θ = 0
};

struct FitProblem {
  LeastSquaresProblem rows;  ///< with no `evaluate`
  std::function<FitWorker()> make_worker;
  int threads = 0;  ///< 0: as many as there are cores
};

/// From the scene's numbers to θ, in parts where a step as a whole loses its poses; false: there is no
/// way in steps of 1/64 and more.
bool reach(const FitWorker& worker, const Eigen::VectorXd& theta);

/// The first of θ, θ/2, θ/4, ... that has predictions, by a step from the scene's numbers; the scene's
/// own 0 where none of 20 has.
[[nodiscard]] Eigen::VectorXd nearest_start(const FitWorker& worker, const Eigen::VectorXd& theta);

/// A fit by that worker as it stands. `progress` can stop it.
[[nodiscard]] LeastSquaresResult fit_by(const FitWorker& worker,
                                        LeastSquaresProblem rows,
                                        const Eigen::VectorXd& start,
                                        StudyProgress& progress,
                                        LeastSquaresOptions options = {});

/// Of samples and profiles: θ to 1e-3 posterior sd where the cost is some hundreds.
inline constexpr double kStudyTolerance = 1e-9;

}  // namespace condyle
