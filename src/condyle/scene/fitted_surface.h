#pragma once

/// A surface of a scene that can be evaluated, and how it came to be: plain data.

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "condyle/mesh/triangle_mesh.h"
#include "condyle/surface/surface.h"

namespace condyle {

/// How a patch came out; distances in mm, between the patch and the mesh of the articular region.
struct FitReport {
  std::string surface;    ///< name
  int mesh_vertices = 0;  ///< in the region
  std::array<int, 2> control_points = {0, 0};
  double smoothing_length = 0;                      ///< [mm]
  double condition = 0;                             ///< of the normal equations
  double rms = 0, p95 = 0, max = 0;                 ///< from the mesh to the patch
  double back_rms = 0, back_p95 = 0, back_max = 0;  ///< from the patch, where known, to the mesh
  double core_rms = 0, core_max = 0;  ///< farther than 4 mm from the edge of the region
  double normal_rms = 0;              ///< [rad], core
  std::array<double, 2> curvature_range = {
      0, 0};  ///< least and greatest principal curvature in the core [1/mm]
  std::array<double, 2> extent = {0, 0};  ///< of the part that can touch, along u and v [mm]
  std::array<double, 2> turn = {0, 0};    ///< of the normal along them [rad]
  double area = 0;                        ///< of that part [mm²]
  double sheet_below = 0;                 ///< to another sheet of the mesh, left out; 0: none [mm]
  double seconds = 0;
  std::vector<std::string> notes;  ///< what was dropped, mended or suspicious, one line each
};

struct FittedSurface {
  std::shared_ptr<const Surface> surface;
  std::optional<FitReport> report;  ///< patches only
  TriangleMesh region = {};  ///< patches only: the part of the mesh that was fitted, moved with it
  std::shared_ptr<const TriangleMesh> bone =
      {};  ///< patches fitted to the mesh of their body only: all of it, as body_mesh returns it
};

}  // namespace condyle
