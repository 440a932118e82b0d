#pragma once

/// A straight piece of a path, frame of a surface that it passes [mm].

#include <Eigen/Core>

namespace condyle {

struct StraightPiece {
  Eigen::Vector3d U, V;
};

}  // namespace condyle
