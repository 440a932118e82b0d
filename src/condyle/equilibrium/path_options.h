#pragma once

/// How a path of equilibria is followed (arc_length.h).

#include <functional>
#include <optional>

#include "condyle/equilibrium/drive.h"
#include "condyle/equilibrium/pose_result.h"

namespace condyle {

struct PathOptions {
  double longest = 0.1;  ///< motion of the body in one step, in units of L
  int most_poses = 2000;
  std::optional<Drive> drive = {};  ///< of all that is not swept; absent: the model's nominal one
  std::function<void(const PoseResult&)> on_pose = {};  ///< called after each pose, in order
};

}  // namespace condyle
