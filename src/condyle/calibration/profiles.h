#pragma once

/// Profiles of the cost: one parameter held, all others fitted anew. Straight parabolas where the delta
/// method holds.

#include "condyle/calibration/calibration.h"
#include "condyle/calibration/fit_problem.h"

namespace condyle {

/// Of the parameters whose posterior sd is smallest beside the prior's, at most `most` of them and none
/// at a bound: 20 values over ±3 posterior sd, cut to the bounds, each fitted from the one before it,
/// outwards from the least. NaN: there was no fit. In the order of the parameters.
[[nodiscard]] std::vector<Profile> find_profiles(const FitProblem& problem,
                                                 const LeastSquaresResult& least,
                                                 const Identifiability& known,
                                                 int most,
                                                 StudyProgress& progress);

}  // namespace condyle
