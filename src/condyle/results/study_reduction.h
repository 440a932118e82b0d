#pragma once

/// From the samples of a study's file to what they say, one output after the other.

#include <string>
#include <vector>

#include "condyle/equilibrium/pose_result.h"
#include "condyle/on_progress.h"
#include "condyle/results/hdf5_file.h"
#include "condyle/study/study_plan.h"
#include "condyle/study/study_summary.h"

namespace condyle {

/// Names of the knees; those that several would share get a number.
[[nodiscard]] std::vector<std::string> knee_names(const StudyPlan& plan);

/// Reads /outputs of the file, writes /bands, /indices and /failures, and, of several knees with more than
/// one point each, the same below /knees/NAME. `theta` by parameters, then samples; `nominal` by knees; nothing
/// depends on `threads` (0: as many as there are cores).
StudySummary write_summaries(const Hdf5Group& root,
                             const StudyPlan& plan,
                             const std::vector<std::vector<double>>& theta,
                             const std::vector<const SweepResult*>& nominal,
                             int threads,
                             const OnProgress& on_output);

}  // namespace condyle
