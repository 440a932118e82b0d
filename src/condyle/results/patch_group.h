#pragma once

/// The group of one fitted surface: /patches/SURFACE.

#include <string>

#include "condyle/results/hdf5_file.h"
#include "condyle/results/run_file.h"
#include "condyle/scene/scene.h"

namespace condyle {

void write_patch(const Hdf5Group& group, const RunPatch& patch, const Scene& scene);

/// Refuses what a patch could not be evaluated with: another degree than 2 to 5, knots that do not ascend,
/// anything that is no number.
[[nodiscard]] RunPatch read_patch(const Hdf5Group& group,
                                  const std::string& surface,
                                  const Scene& scene);

}  // namespace condyle
