#pragma once

/// A sweep as a group of a result file, for the runs and comparisons that hold one.

#include "condyle/equilibrium/pose_result.h"
#include "condyle/results/hdf5_file.h"
#include "condyle/scene/scene.h"
#include "condyle/scene/sweep_range.h"

namespace condyle {

/// All of /sweep but the events; its values in `unit`.
void write_sweep(const Hdf5Group& sweep,
                 const Scene& scene,
                 const Unit& unit,
                 const std::vector<PoseResult>& poses);
[[nodiscard]] std::vector<PoseResult> read_sweep(const Hdf5Group& sweep,
                                                 const Scene& scene,
                                                 const Unit& unit);

}  // namespace condyle
