#pragma once

/// What a result file says, without a file: numbers in its units under its names.

#include <filesystem>
#include <vector>

#include "condyle/results/column_tree.h"
#include "condyle/results/run_file.h"
#include "condyle/results/sweep_group.h"

namespace condyle {

/// All that write_run writes of a run, number by number the same.
[[nodiscard]] ColumnTree columns_of(const Run& run);
/// Of that all but /sweep, which may be made by its parts: one of them, and what is not of single poses.
[[nodiscard]] ColumnTree columns_beside_sweep(const Run& run);
void add_columns(ColumnTree& sweep,
                 SweepPart part,
                 const Scene& scene,
                 const Unit& unit,
                 const std::vector<PoseResult>& poses);
void add_columns_beside_poses(ColumnTree& sweep, const Run& run);

struct RunWithColumns {
  Run run;
  ColumnTree columns;  ///< all that the file holds, as it stands there
};
/// As read_run.
[[nodiscard]] RunWithColumns read_run_with_columns(const std::filesystem::path& path);

}  // namespace condyle
