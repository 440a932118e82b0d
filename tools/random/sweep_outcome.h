#pragma once

/// One random knee swept and judged.

#include <string>
#include <vector>

#include "condyle/results/run_file.h"
#include "random/random_knee.h"

namespace condyle::random_knees {

struct PoseOutcome {
  PoseStatus status = PoseStatus::kNotComputed;
  double seconds = 0;         ///< of the pose and the events before it
  bool is_false = false;      ///< converged, and the verifier says it is wrong
  bool looked_again = false;  ///< not converged, and a second look was taken
  bool found = false;         ///< by which a pose of equilibrium was found there
};

struct SweepOutcome {
  std::string kind;       ///< kind_of
  std::string refused;    ///< the line of an InputError
  std::string exception;  ///< anything else that was thrown: a defect
  std::vector<PoseOutcome> poses;
  std::vector<std::string> faults;  ///< of the verifier, and what the second look found
  double seconds = 0;               ///< of processor time: the sweep
  double checked_seconds = 0;       ///< and its checks
};

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
