#pragma once

/// What a result file says, without a file: numbers in its units under its names.

#include <filesystem>
#include <utility>

#include "condyle/results/column_tree.h"
#include "condyle/results/run_file.h"
#include "condyle/scene/sweep_range.h"

namespace condyle {

/// All that write_run writes of a run, number by number the same.
[[nodiscard]] ColumnTree columns_of(const Run& run);
/// Likewise /sweep of one pose; its value in `unit`.
[[nodiscard]] ColumnTree columns_of(const Scene& scene, const Unit& unit, const PoseResult& pose);

struct RunWithColumns {
  Run run;
  ColumnTree columns;  ///< all that the file holds, as it stands there
};
/// As read_run.
[[nodiscard]] RunWithColumns read_run_with_columns(const std::filesystem::path& path);

}  // namespace condyle
