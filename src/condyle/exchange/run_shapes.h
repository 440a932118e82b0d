#pragma once

/// The rigid things of a run as triangle meshes in the frames of their bodies: bones and articular
/// surfaces.

#include <string>
#include <vector>

#include "condyle/results/run_file.h"

namespace condyle {

struct RunShape {
  std::string name;  ///< "femur bone", or the surface's name
  int body = -1;
  bool bone = false;  ///< else an articular surface
  bool closed = false;
  TriangleMesh mesh;                     ///< [mm], body frame
  std::vector<Eigen::Vector3d> normals;  ///< unit, one for each vertex
};

struct ShapeOptions {
  std::size_t bone_triangles = 0;  ///< at most about so many in each bone; 0: as they are
  double patch_spacing = 1.2;      ///< between the vertices of a patch [mm]
  bool drop_covered = false;       ///< leave out of bones what a patch fitted to them replaces, so
                                   ///< that the two do not pierce each other
};

/// Bodies without a mesh, and patches that the run does not hold, are left out. Meshes are thinned
/// out by meshoptimizer: vertices are dropped, never moved, and keep the normals of the whole mesh.
[[nodiscard]] std::vector<RunShape> run_shapes(const Run& run, const ShapeOptions& options = {});

}  // namespace condyle
