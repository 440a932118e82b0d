#pragma once

/// A triangle mesh as plain data. Vertices in mm, in the frame of the body (or cartilage) that the
/// file describes.

#include <Eigen/Core>

#include <array>
#include <vector>

namespace condyle {

struct TriangleMesh {
  std::vector<Eigen::Vector3d> vertices;  ///< [mm]
  std::vector<std::array<int, 3>>
      triangles;  ///< indices into vertices, counter-clockwise from outside
};

}  // namespace condyle
