#pragma once

/// Pull of a path at a pose, and which of its surfaces it touches there.

#include <optional>
#include <vector>

#include "condyle/wrapping/path_ends.h"
#include "condyle/wrapping/path_state.h"
#include "condyle/wrapping/shape_geometry.h"

namespace condyle {

/// A surface as a path uses it; W its body.
struct PathSurface {
  WrapShape shape;
  RigidTransform X_WS, X_SW;
  bool on_A = false;
  std::optional<Eigen::Vector3d> side;  ///< normal on the side given, frame of the surface
};

struct PathPose {
  const std::vector<PathSurface>& surfaces;
  const PathEnds& ends;
  const RigidTransform& X_BA;
};

/// L [mm] and, if asked for, the wrench of 1 N; what is held in `state` stays, unless it is unknown or no
/// path can be found with it.
double pull_path(const PathPose& pose, PathState state, Wrench* unit);

/// Opens and closes surfaces one by one until nothing changes; true where the statuses are others then.
bool revise_path(const PathPose& pose, PathState state);

}  // namespace condyle
