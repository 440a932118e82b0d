#pragma once

/// What a sweep (sweep.h) is asked for, and what it takes over.

#include <functional>
#include <optional>
#include <vector>

#include "condyle/equilibrium/drive.h"
#include "condyle/equilibrium/known_poses.h"
#include "condyle/equilibrium/pose_result.h"

namespace condyle {

struct SweepOptions {
  bool stability = true;  ///< reduced stiffness of each pose
  bool events = true;  ///< locate what happens between poses, and find anew those on another branch
  std::optional<Drive> drive;  ///< of all that is not swept; absent: the model's nominal one
  /// Taken over where their values are met, failures too: a solved one is polished and described
  /// anew, not searched for. The first value that is not known starts from the pose before it in
  /// the sweep, or, where there is none, from the known one with the nearest value.
  std::vector<KnownPose> known;
  /// Called for each pose in order, when it is final: after a gap for all that lie in it.
  std::function<void(const PoseResult&)> on_pose;
  /// Called for each pose that was not taken over, when the events before it are located: all that
  /// another sweep has to know.
  std::function<void(const KnownPose&)> on_computed;
  /// Called before that for each pose that was not found and was not taken over, as soon as it is given up from the side
  /// of the pose before it.
  std::function<void(const KnownPose&)> on_open;
};

}  // namespace condyle
