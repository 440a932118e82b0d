#pragma once

/// The points of a study from a table (CSV): a column for each number that varies, a row for each point;
/// what `condyle calibrate --posterior` writes is one. Columns of other names are not read.

#include <string>
#include <vector>

#include "condyle/calibration/free_parameter.h"
#include "condyle/scene/scene.h"
#include "condyle/scene/study_description.h"

namespace condyle {

/// θ of each row, as many as `study` asks for (0: all), in the order of `names`: those of `numbers`, and
/// what else varies. Changes are θ itself (mm, 1, logarithms of factors); with table_holds_values the numbers themselves in the units of
/// the scene, of insertions how far they lie off, and none of several that have one change in common. Throws
/// InputError: file, line, column and what was expected.
[[nodiscard]] std::vector<std::vector<double>> read_study_table(
    const StudyDescription& study,
    const std::vector<std::string>& names,
    const std::vector<FreeParameter>& numbers,
    const Scene& scene);

}  // namespace condyle
