#pragma once

/// What a result file holds of a motion beyond its poses: /simulate (docs/results.md).

#include "condyle/network/simulate.h"
#include "condyle/results/hdf5_file.h"

namespace condyle {

void write_simulation(const Hdf5Group& group, const Scene& scene, const Simulation& simulation);

/// Frames with time, velocities and energies, events, mass; `poses` of the result are left empty.
[[nodiscard]] Simulation read_simulation(const Hdf5Group& group, const Scene& scene);

}  // namespace condyle
