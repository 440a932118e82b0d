#pragma once

/// How a wrapped ligament lies at each pose: the group /sweep/ligaments/NAME/path.

#include "condyle/equilibrium/pose_result.h"
#include "condyle/results/hdf5_file.h"
#include "condyle/scene/scene.h"

namespace condyle {

/// Nothing of a straight ligament.
void write_path(const Hdf5Group& ligament,
                const Scene& scene,
                const std::vector<PoseResult>& poses,
                std::size_t index);

/// Of a file that has it.
void read_path(const Hdf5Group& ligament,
               const Scene& scene,
               std::vector<PoseResult>& poses,
               std::size_t index);

}  // namespace condyle
