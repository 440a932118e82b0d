#pragma once

/// What earlier runs left for a sweep to go on from: the result file, and the journal of a run that
/// was stopped.

#include <filesystem>
#include <string>
#include <vector>

#include "condyle/equilibrium/known_poses.h"
#include "condyle/results/journal.h"

namespace condyle {

struct EarlierPoses {
  std::vector<KnownPose> poses;
  std::size_t journal_bytes = 0;  ///< of the journal that are to be kept
  std::string message;            ///< one line for the user; may be empty
};

/// With `resume` the poses of `output` and of its journal, else none, and a word where a stopped
/// run could be resumed. Throws InputError where they belong to another scene or other surfaces.
[[nodiscard]] EarlierPoses earlier_poses(const std::filesystem::path& output,
                                         bool resume,
                                         const Scene& scene,
                                         const std::vector<FittedSurface>& surfaces);

}  // namespace condyle
