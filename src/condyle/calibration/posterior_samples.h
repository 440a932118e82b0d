#pragma once

/// Samples of the posterior by randomising, then optimising ("randomised maximum likelihood", [Ba 2021]):
/// the least for data with noise of their own sd added and for a mean of the prior that is drawn from
/// it. For predictions linear in θ these are draws of the posterior itself, else nearly so.

#include "condyle/calibration/fit_problem.h"

namespace condyle {

struct PosteriorSamples {
  Eigen::MatrixXd theta;  ///< a row each, in the order of their numbers
  int lost = 0;           ///< that did not come to a least
  Eigen::VectorXd sd;     ///< of each θ; 0 of fewer than two
};

/// `count` refits from the least θ, each from poses that were brought there from the scene's. The prior
/// of a θ that has none is not drawn. Stopped: those that were done.
[[nodiscard]] PosteriorSamples posterior_samples(const FitProblem& problem,
                                                 const Eigen::VectorXd& theta,
                                                 int count,
                                                 unsigned seed,
                                                 StudyProgress& progress);

}  // namespace condyle
