#pragma once

#include "condyle/elements/wrench.h"
#include "condyle/wrapping/path_pose.h"

namespace condyle {

/// L [mm] and, if asked for, the wrench of 1 N; what is held in `state` stays, unless it is unknown or no
/// path can be found with it.
double pull_path(const PathPose& pose, PathState state, Wrench* unit);

}  // namespace condyle
