#pragma once

/// Seams of a mesh: where two sheets of it run along each other and share no edges, as a crack narrower than its triangles
/// or a row of vertices on one side only leaves them. What lies beyond a seam is not linked with the rest.

#include <Eigen/Core>

#include <utility>
#include <vector>

#include "condyle/mesh/triangle_mesh.h"

namespace condyle {

/// What counts as beside an edge, of its length.
inline constexpr double kBesideRim = 0.3;

/// An edge of one triangle alone.
struct Rim {
  int a, b, triangle;
  Eigen::Vector3d middle, inward;  ///< [mm]; unit, to the side on which the triangle lies
  double length, height;           ///< [mm], the latter of the triangle over it
};

struct Seams {
  std::vector<Rim> rims;
  std::vector<std::pair<std::size_t, std::size_t>>
      pairs;          ///< of rims on either side, in rising order
  double length = 0;  ///< of the boundary beside which other boundary runs on its far side [mm]
};
[[nodiscard]] Seams find_seams(const TriangleMesh& mesh);

}  // namespace condyle
