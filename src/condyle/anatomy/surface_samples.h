#pragma once

/// A triangle mesh as points of even spacing that carry its area and normals: what a registration
/// looks at, whatever the mesh's own resolution.

#include <vector>

#include "condyle/mesh/triangle_mesh.h"

namespace condyle {

struct SurfaceSamples {
  std::vector<Eigen::Vector3d> points;   ///< [mm], mean of the surface around
  std::vector<Eigen::Vector3d> normals;  ///< unit, mean of the surface around
  std::vector<double> areas;             ///< each one's share [mm²]
  std::vector<int> parts;                ///< connected part of the mesh that each is on
  double spacing = 0;                    ///< [mm]
};

/// Cubes of edge `spacing` [mm], each side of the surface in a cube for itself (by the axis that its
/// normal is nearest to). Triangles whose `keep` is false are left out.
[[nodiscard]] SurfaceSamples sample_surface(const TriangleMesh& mesh,
                                            const std::vector<bool>& keep,
                                            double spacing);

}  // namespace condyle
