#pragma once

#include "condyle/elements/wrench.h"
#include "condyle/wrapping/noted_length.h"
#include "condyle/wrapping/path_pose.h"

namespace condyle {

/// L [mm] and, if asked for, the wrench of 1 N; what is held in `state` stays, unless it is unknown or no
/// path can be found with it. `last`: the piece to the end that moves, of which the beginning is not told
/// where the path is straight (rest 0). `small`: of path_over (one_surface.h).
double pull_path(const PathPose& pose,
                 PathState state,
                 Wrench* unit,
                 LastPiece& last,
                 double small = kSmallStep);

}  // namespace condyle
