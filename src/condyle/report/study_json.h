#pragma once

/// What `condyle study` did, for scripts: one JSON object (docs/command-line.md).

#include <string>

#include "condyle/report/summary_json.h"
#include "condyle/results/study_file.h"

namespace condyle {

[[nodiscard]] std::string json_study(const CommandSummary& summary, const StudyView& view);

/// Of a part, or of a study that was stopped: chunks that are there, of how many.
[[nodiscard]] std::string json_part_of_study(const CommandSummary& summary,
                                             std::uint64_t done,
                                             std::uint64_t chunks);

}  // namespace condyle
