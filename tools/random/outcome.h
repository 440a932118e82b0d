#pragma once

/// What became of one random knee.

#include <string>
#include <vector>

#include "condyle/contact/pose_status.h"

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
  double set_up_seconds = 0;        ///< of processor time: model and covers
  double seconds = 0;               ///< these and the sweep
  double checked_seconds = 0;       ///< and its checks
};

}  // namespace condyle::random_knees
