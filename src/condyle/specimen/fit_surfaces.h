#pragma once

/// From the described surfaces of a scene to surfaces that can be evaluated: exact kinds are made,
/// patches are fitted to the meshes (loaded, cleaned, the articular region found, fitted).

#include <memory>
#include <vector>

#include "condyle/mesh/triangle_mesh.h"
#include "condyle/on_progress.h"
#include "condyle/scene/fitted_surface.h"
#include "condyle/scene/scene.h"
#include "condyle/specimen/mesh_reader.h"
#include "condyle/surface/surface.h"

namespace condyle {

/// A described surface of any kind but a patch.
[[nodiscard]] std::unique_ptr<Surface> make_exact_surface(const SurfaceDescription& surface);

/// One entry per Scene::surfaces, in the frames of the scene; where these have their origins does
/// not matter. Throws InputError for meshes that cannot be used and layers that have no room. `on_patch` is told of each patch
/// that is fitted, from either of two threads but never from both at once. `threads`: 2, or 1 for
/// callers that have threads of their own.
[[nodiscard]] std::vector<FittedSurface> fit_surfaces(const Scene& scene,
                                                      const OnProgress& on_patch = {},
                                                      const MeshReader& read = {},
                                                      int threads = 2);

/// The mesh of a body, loaded and cleaned, in mm; empty where the scene names none. `told` gets a line for all that was mended,
/// "body "femur": 2 stray pieces (38 triangles) dropped", before which "warning: " stands where that may be wrong.
[[nodiscard]] TriangleMesh load_body_mesh(const BodyDescription& body,
                                          std::vector<std::string>* told = nullptr);

/// The same, taken from the fitted surfaces where one was fitted to it: a file is read once.
[[nodiscard]] TriangleMesh body_mesh(const Scene& scene,
                                     int body,
                                     const std::vector<FittedSurface>& surfaces,
                                     std::vector<std::string>* told = nullptr);
/// Of all bodies; empty ones where the scene names none. What fits told already is not told again.
[[nodiscard]] std::vector<TriangleMesh> body_meshes(const Scene& scene,
                                                    const std::vector<FittedSurface>& surfaces,
                                                    std::vector<std::string>* told = nullptr);

}  // namespace condyle
