#pragma once

/// --from, --to and --step: they stand in for the range of a scene, in the scene's own unit.

#include <optional>
#include <string>

#include "condyle/scene/scene.h"

namespace CLI {
class App;
}

namespace condyle {

struct RangeOptions {
  std::optional<double> from, to, step;
};

void add_range_options(CLI::App& command, RangeOptions& options);

/// Throws InputError where the scene `file` has no [sweep], or the range leads nowhere.
void override_range(const std::string& file, const RangeOptions& options, Scene& scene);

}  // namespace condyle
