#pragma once

/// Which of its surfaces a path touches at a pose.

#include "condyle/wrapping/path_pose.h"

namespace condyle {

/// Opens and closes surfaces one by one until nothing changes; true where the statuses are others then.
bool revise_path(const PathPose& pose, PathState state);

/// A surface that a straight piece of a path that was found runs through where it should pass it; -1 where
/// none is.
[[nodiscard]] int surface_run_through(const PathPose& pose, const PathNumbers& state);

/// Statuses and path anew; `state` may hold the sides passed. The outcome in it says whether one was found.
PathChain start_path(const PathPose& pose, PathState& state);

/// The statuses held; each link from scratch. False where one cannot be brought in.
bool rescue_path(const PathPose& pose, PathState& state, PathChain& chain);

/// Another path near one that is stationary but not the shortest: starts from sides turned about the line.
bool find_shorter(const PathPose& pose, PathChain& chain);

}  // namespace condyle
