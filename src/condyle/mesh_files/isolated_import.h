#pragma once

/// Formats that assimp knows, read by it in a process of its own.

#include <filesystem>
#include <string>

#include "condyle/mesh/triangle_mesh.h"

namespace condyle {

struct ImportLimits {
  double seconds = 60;               ///< of processor time; twice that on the clock
  double memory = 4.0 * (1L << 30);  ///< address space beyond what this process has [bytes]
};

/// Whether assimp has a reader for the ending (".glb").
[[nodiscard]] bool importer_knows(const std::string& ending);

/// All triangles of the file, moved by the transforms of its nodes, in its own unit and single
/// precision. Throws InputError in one line where the importer refuses the file, crashes on it,
/// or needs more than the limits: nothing that a file holds reaches this process but a mesh.
[[nodiscard]] TriangleMesh import_isolated(const std::filesystem::path& file,
                                           const ImportLimits& limits = {});

}  // namespace condyle
