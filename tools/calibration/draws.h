#pragma once

/// Draws of truth and noise: the truth from the prior, measurements of it with normal noise, a fit of
/// another copy of the knee from the scene's own numbers; how often the intervals hold the truth, and
/// how well tests are predicted that were not fitted.

#include <functional>
#include <vector>

#include "calibration/study_knee.h"
#include "condyle/calibration/free_parameter.h"
#include "condyle/calibration/identifiability.h"
#include "condyle/calibration/least_squares.h"

namespace condyle::calibration_study {

struct DrawPlan {
  TestPlan fitted, unseen;
  int draws = 200;
  double noise = 1;  ///< of the rows' standard deviations
  double truth = 1;  ///< of the prior's, from which the truth is drawn
  double prior = 1;  ///< of the prior's sds, in the fit; great: none
  unsigned seed = 1;
  int starts =
      1;  ///< the scene's numbers, then draws from the prior, until one explains what has no noise
  bool by_differences = false;  ///< central differences of knees built anew, as from outside
};

struct DrawOutcome {
  Eigen::VectorXd truth;
  LeastSquaresResult fit;  ///< the best of those begun
  int starts = 0;          ///< fits begun
  Identifiability known;
  double unseen_before = 0, unseen_after = 0;  ///< rms of y - truth over the rows' sds
  double covered_unseen = 0;  ///< share of unseen rows whose 95 % interval holds the truth
  double reduced_chi_square = 0;
  bool beyond_limit = false;  ///< above the 97.5 % quantile
};

/// ½ χ² of a fit that explains measurements without noise: other leasts lie above 1e-5.
inline constexpr double kNoCost = 1e-10;

struct Draws {
  std::vector<FreeParameter> parameters;
  std::vector<DrawOutcome> outcomes;
  std::size_t rows = 0, poses = 0;
  int skipped = 0;  ///< truths that have no pose in some test: drawn again
  int failed = 0;   ///< fits that did not converge
};

/// `truth` is measured, `model` is fitted: the same knee, or on purpose another one, with the same
/// free parameters. `disturb` changes the scene of the truth in each draw.
[[nodiscard]] Draws draw_and_fit(const StudyKnee& model,
                                 const StudyKnee& truth,
                                 const DrawPlan& plan,
                                 const std::function<void(Scene&, unsigned draw)>& disturb = {});

/// How fits of one set of measurements from starts of the prior end.
struct Starts {
  int starts = 0, same = 0;  ///< same: cost within 1e-6 of the least
  double next = 0;           ///< greatest cost over the least
  double distance = 0;       ///< of the farthest θ that has the same cost [prior sd]
};
[[nodiscard]] Starts fit_from_starts(const StudyKnee& knee, const DrawPlan& plan, int starts);

/// Of all parameters together, of the one with the fewest and of the one with the most: share of 95 %
/// intervals that hold the truth.
struct Coverage {
  double pooled = 0, least = 0, most = 0;
};
[[nodiscard]] Coverage coverage_of(const Draws& draws);

}  // namespace condyle::calibration_study
