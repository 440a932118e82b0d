#pragma once

/// What a command does before it computes something from a scene.

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "condyle/app/talk.h"
#include "condyle/results/make_run.h"
#include "condyle/scene/fitted_surface.h"

namespace condyle {

/// What a command starts from that computes something from a scene.
struct Study {
  Scene scene;
  std::vector<FittedSurface> surfaces;
  Run run;
};
/// Reads the scene of a command that writes `output`, lets `check` look at it, and fits its
/// surfaces aloud. Throws InputError, also where `output` cannot be written.
[[nodiscard]] Study begin_study(const Talk& talk,
                                const std::string& scene,
                                const std::string& output,
                                const std::function<void(const Scene&)>& check);

}  // namespace condyle
