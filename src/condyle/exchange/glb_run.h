#pragma once

/// A run as an animated scene in glTF 2.0 (.glb). Lengths in m; y superior, z anterior, x to the
/// person's left. docs/exchange.md tells what stands in the file.

#include <string>
#include <vector>

#include "condyle/exchange/run_shapes.h"
#include "condyle/exchange/shown_poses.h"
#include "condyle/results/run_file.h"

namespace condyle {

/// The bytes of a file that shows these poses.
[[nodiscard]] std::string glb_of_poses(const Run& run,
                                       const std::vector<ShownPose>& shown,
                                       const ShapeOptions& options = {});

/// The same of all poses with a place, results or not. Throws InputError, naming `file`, where none has one.
[[nodiscard]] std::string glb_of_run(const Run& run,
                                     const std::string& file,
                                     const ShapeOptions& options = {});

}  // namespace condyle
