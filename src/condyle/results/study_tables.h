#pragma once

/// Tables of a study (CSV, first row the names of the columns; an empty cell is no number).

#include <filesystem>
#include <string>

#include "condyle/results/study_file.h"
#include "condyle/results/study_journal.h"

namespace condyle {

/// A row for each output and pose, of all knees and of each: knee, output, unit, swept value, samples,
/// nominal, mean, sd, p5, p25, p50, p75, p95.
[[nodiscard]] std::string bands_csv(const StudyView& view);

/// A row for each output, pose and parameter: first and total index with their intervals, rank
/// correlation.
[[nodiscard]] std::string indices_csv(const StudyView& view);

/// A row for each sample and pose: sample, knee, θ, swept value, status, outputs. Not held in memory.
void write_sample_table(const std::filesystem::path& path,
                        const StudyPlan& plan,
                        const StudyJournals& journals);

}  // namespace condyle
