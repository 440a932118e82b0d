#pragma once

/// The edge of the data: outline of a region, its inside in the parameter plane, and the validity
/// mask of a patch.

#include <array>
#include <vector>

#include "condyle/mesh/triangle_mesh.h"
#include "condyle/surface/patch.h"

namespace condyle {

/// Holes that no data bridge, and the widest of them.
struct WideHoles {
  int count = 0;
  double perimeter = 0;                              ///< [mm]
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();  ///< of its vertices [mm]
};

struct RegionOutline {
  std::vector<std::array<int, 2>> edges;      ///< boundary edges, small holes left out
  std::vector<std::array<int, 3>> hole_fans;  ///< triangles that close the small holes
  int holes = 0;                              ///< closed this way
  WideHoles wide_holes = {};                  ///< left open
};

/// The perimeter below which a hole of a region is bridged [mm].
[[nodiscard]] double bridged_perimeter(const TriangleMesh& region);

/// Holes of a perimeter below `small_hole` [mm] count as data.
[[nodiscard]] RegionOutline trace_outline(const TriangleMesh& region, double small_hole);

/// Signed distance [mm, in space] of every corner of a grid over the parameter box from the
/// outline, positive inside. `uv` are the parameters of the region's vertices.
void fill_mask(PatchData& patch,
               const TriangleMesh& region,
               const RegionOutline& outline,
               const std::vector<Eigen::Vector2d>& uv);

}  // namespace condyle
