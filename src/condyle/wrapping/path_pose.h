#pragma once

/// A path at a pose: its surfaces, its ends, and the chain of what it touches.

#include <optional>
#include <vector>

#include "condyle/wrapping/path_chain.h"
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

/// The surface as a link, its geodesic not yet told.
[[nodiscard]] ChainLink link_of(const PathPose& pose, int wrap);

/// Straight from end to end.
[[nodiscard]] PathChain without_links(const PathPose& pose);

/// The links that are touched, as they were kept.
[[nodiscard]] PathChain kept_chain(const PathPose& pose, const PathNumbers& state);

void keep(const PathChain& chain, PathState& state);

/// The link on a wrap; -1 where there is none.
[[nodiscard]] int link_on(const PathChain& chain, int wrap);

/// In the order of the surfaces; where it is then.
int add_link(PathChain& chain, const ChainLink& link);

void remove_link(PathChain& chain, int link);

/// The straight piece that passes a surface it does not touch, frame of the surface; and whether its ends
/// are ends of the path.
struct Passing {
  Eigen::Vector3d U, V;
  bool from_C, to_D;
};

[[nodiscard]] Passing passing(const PathPose& pose, const PathChain& chain, int wrap);

/// An end of the path lies inside.
[[nodiscard]] bool ends_inside(const WrapShape& shape, const Passing& line);

/// Depths and arcs below it are round-off [mm].
inline constexpr double kTouch = 1e-10;

[[nodiscard]] inline int count(const PathPose& pose) {
  return static_cast<int>(pose.surfaces.size());
}

}  // namespace condyle
