#pragma once

/// A path over the surfaces that it touches, ground frame [mm]: straight pieces between geodesics. Its
/// unknowns are, of each geodesic, the turn δθ of its first tangent towards b, the shifts δb and δt of its
/// first point, and δℓ of its arc: natural geodesic variations [Scholz 2015].

#include <Eigen/Core>

#include <array>

#include "condyle/math/rigid_transform.h"
#include "condyle/wrapping/geodesic.h"
#include "condyle/wrapping/wrapped_path.h"

namespace condyle {

/// A surface with the geodesic on it.
struct ChainLink {
  int wrap = 0;
  const WrapShape* shape = nullptr;
  bool on_A = false;
  RigidTransform X_GS;                          ///< from the surface's frame to the ground's
  bool starts_here = false, ends_here = false;  ///< an end of the path is anchored on it
  Eigen::Vector3d anchor;                       ///< where, frame of the surface
  Eigen::Vector3d P, t;                         ///< frame of the surface
  double arc = 0;
  Geodesic g;  ///< the frames in the ground frame; made by shoot_links() (solve_chain.h)
};

struct PathChain {
  Eigen::Vector3d X, Y;  ///< ends on B and A; not looked at where a link starts or ends the path
  std::array<ChainLink, kMostWraps> links;
  int n = 0;
};

}  // namespace condyle
