#pragma once

/// How sure the poses of a sweep are, given the meshes: /sweep/uncertainty of a result file.

#include <memory>
#include <string>
#include <vector>

#include "condyle/results/hdf5_file.h"
#include "condyle/study/mesh_uncertainty.h"

namespace condyle {

void write_uncertainty(const Hdf5Group& group, const MeshUncertainty& uncertainty);

/// What it is of follows from the scene; throws InputError where the file holds something else.
[[nodiscard]] std::shared_ptr<const MeshUncertainty> read_uncertainty(const Hdf5Group& group,
                                                                      const Scene& scene,
                                                                      std::size_t poses);

/// Of the output at `place` ("joint/flexion"), by poses, in units used inside; null where there is
/// none.
[[nodiscard]] const std::vector<double>* inside_sd(const MeshUncertainty& uncertainty,
                                                   const std::string& place);

/// Half the width of an interval of 95 %, in standard deviations: Student's t for so few sweeps, 2 or
/// more, that found the pose.
[[nodiscard]] double interval_of(int sweeps);

/// One line: what the meshes leave beside their patches, and how far the poses that it does the most to
/// scatter.
[[nodiscard]] std::string uncertainty_words(const MeshUncertainty& uncertainty);

}  // namespace condyle
