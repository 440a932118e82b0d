#pragma once

/// What is said of a run that holds no poses to those who want some.

#include <string>

#include "condyle/results/run_file.h"

namespace condyle {

/// "holds no poses", and where another kind of study stores none, which.
[[nodiscard]] inline std::string no_poses(const Run& run) {
  std::string words = "holds no poses";
  if (run.kind() == RunKind::kLaxity) words += " (a test of laxity stores none)";
  if (run.kind() == RunKind::kCalibration) words += " (a calibration stores none)";
  return words;
}

}  // namespace condyle
