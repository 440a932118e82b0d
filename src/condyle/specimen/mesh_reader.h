#pragma once

#include <functional>
#include <string>

#include "condyle/input_error.h"
#include "condyle/mesh/triangle_mesh.h"
#include "condyle/scene/scene.h"

namespace condyle {

/// What stands in for reading a mesh file, from either of two threads: a mesh in memory, in mm.
using MeshReader = std::function<TriangleMesh(const MeshFile&)>;

/// The mesh as it stands in the file, in mm (mesh_files/load_mesh.h). Throws InputError, which begins with where the scene
/// names the mesh.
[[nodiscard]] TriangleMesh load_mesh(const MeshFile& file);

/// The error `what` about a mesh, after where the scene names it.
[[nodiscard]] InputError error_of_mesh(const MeshFile& file, const std::string& what);

}  // namespace condyle
