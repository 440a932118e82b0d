#pragma once

/// Formats that assimp knows, read by it in a process of its own.

#include <filesystem>
#include <string>

#include "condyle/mesh/triangle_mesh.h"
#include "condyle/mesh_files/child_limits.h"

namespace condyle {

/// Whether assimp has a reader for the ending (".glb").
[[nodiscard]] bool importer_knows(const std::string& ending);

/// All triangles of the file, moved by the transforms of its nodes, in its own unit and single
/// precision. Throws InputError in one line where the importer refuses the file, crashes on it,
/// or needs more than the limits: nothing that a file holds reaches this process but a mesh.
[[nodiscard]] TriangleMesh import_isolated(const std::filesystem::path& file,
                                           const ChildLimits& limits = {});

}  // namespace condyle
