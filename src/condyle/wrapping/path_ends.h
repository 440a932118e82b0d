#pragma once

/// The ends of a path with regard to the surfaces of their own bodies.

#include <array>
#include <vector>

#include "condyle/wrapping/wrapped_path.h"

namespace condyle {

struct PathEnd {
  Eigen::Vector3d given;   ///< frame of its body
  Eigen::Vector3d at;      ///< where the path begins: `given`, or the anchor
  Eigen::Vector3d anchor;  ///< the same in the frame of the surface
  int wrap = -1;           ///< on which it is anchored
};

struct PathEnds {
  std::array<PathEnd, 2> end;         ///< C, D
  std::array<bool, 7> passed_over{};  ///< surfaces that the path has nothing to do with
};

[[nodiscard]] PathEnds path_ends(const std::vector<PathWrap>& wraps,
                                 const Eigen::Vector3d& x_C,
                                 const Eigen::Vector3d& s_D,
                                 InsideRule inside);

}  // namespace condyle
