#pragma once

/// A run as an animated scene in glTF 2.0 (.glb). Lengths in m; y superior, z anterior, x to the
/// person's left. docs/exchange.md tells what stands in the file.

#include <cstddef>
#include <string>

#include "exchange/run_shapes.h"
#include "results/run_file.h"

namespace condyle {

/// The bytes of the file. Throws InputError, naming `file`, where no pose has converged.
[[nodiscard]] std::string glb_of_run(const Run& run,
                                     const std::string& file,
                                     const ShapeOptions& options = {});

}  // namespace condyle
