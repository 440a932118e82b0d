#pragma once

/// By which way the poses of a sweep were found: `route` and `route_from`, and under `newton` the
/// relative residual of each iteration (`history`, NaN beyond the last one), `parts`, `searches`,
/// `closings` and `openings` (equilibrium/pose_trace.h). There where the solver told them.

#include <vector>

#include "condyle/equilibrium/pose_result.h"
#include "condyle/results/hdf5_file.h"

namespace condyle {

void write_traces(const Hdf5Group& sweep,
                  const Hdf5Group& newton,
                  const std::vector<PoseResult>& poses);
void read_traces(const Hdf5Group& sweep, const Hdf5Group& newton, std::vector<PoseResult>& poses);

}  // namespace condyle
