#pragma once

/// Poses that did not converge, looked at once more: by solvers that start elsewhere.

#include <vector>

#include "condyle/results/run_file.h"
#include "random/outcome.h"

namespace condyle::random_knees {

/// Notes at each pose of `outcome` that did not converge whether an equilibrium is found there from one of
/// several starts, or from a pose nearby on a slower way; only one that the verifier has nothing against counts.
void look_again(const Run& run, const std::vector<FittedSurface>& surfaces, SweepOutcome& outcome);

}  // namespace condyle::random_knees
