#pragma once

/// From the described surfaces of a scene to surfaces that can be evaluated: exact kinds are made,
/// patches are fitted to the meshes (mesh room: load, clean, articular region; surface room: fit).

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "condyle/mesh/triangle_mesh.h"
#include "condyle/on_progress.h"
#include "condyle/scene/scene.h"
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

/// A described surface of any kind but a patch.
[[nodiscard]] std::unique_ptr<Surface> make_exact_surface(const SurfaceDescription& surface);

/// What stands in for reading a mesh file, from either of two threads: a mesh in memory, in mm.
using MeshReader = std::function<TriangleMesh(const MeshFile&)>;

/// One entry per Scene::surfaces, in the frames of the scene; where these have their origins does
/// not matter. Throws InputError for meshes that cannot be used. `on_patch` is told of each patch
/// that is fitted, from either of two threads but never from both at once.
[[nodiscard]] std::vector<FittedSurface> fit_surfaces(const Scene& scene,
                                                      const OnProgress& on_patch = {},
                                                      const MeshReader& read = {});

/// The mesh of a body, loaded and cleaned, in mm; empty where the scene names none.
[[nodiscard]] TriangleMesh load_body_mesh(const BodyDescription& body);

/// The same, taken from the fitted surfaces where one was fitted to it: a file is read once.
[[nodiscard]] TriangleMesh body_mesh(const Scene& scene,
                                     int body,
                                     const std::vector<FittedSurface>& surfaces);

}  // namespace condyle
