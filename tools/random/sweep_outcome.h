#pragma once

/// One random knee swept and judged.

#include <string>
#include <vector>

#include "condyle/results/run_file.h"
#include "random/outcome.h"
#include "random/random_knee.h"

namespace condyle::random_knees {

struct LookOptions {
  bool pushes = false;      ///< energy under small pushes too
  bool second_look = true;  ///< at poses that did not converge
};

/// Processor time of this thread [s].
[[nodiscard]] double thread_seconds();

/// The knee as a run without poses: read from its text, patches as they are. Throws InputError.
[[nodiscard]] Run run_of(const RandomKnee& knee);
/// As fit_surfaces makes them.
[[nodiscard]] std::vector<FittedSurface> surfaces_of(const RandomKnee& knee, const Scene& scene);

/// Throws nothing.
[[nodiscard]] SweepOutcome sweep_and_judge(const RandomKnee& knee, const LookOptions& options);

}  // namespace condyle::random_knees
