#pragma once

/// What the comparison of runs found, for scripts: one JSON object (docs/command-line.md).

#include <string>

#include "condyle/report/compared_runs.h"
#include "condyle/report/summary_json.h"

namespace condyle {

[[nodiscard]] std::string json_compared_runs(const CommandSummary& summary,
                                             const RunComparison& comparison);

}  // namespace condyle
