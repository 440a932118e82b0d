#pragma once

/// What a mesh file promises, checked before and after the importer reads it: a cut or damaged file
/// is bad input, never a smaller mesh.

#include <filesystem>
#include <optional>

namespace condyle {

/// Numbers that a file states about itself; absent where its format does not state them.
struct MeshFileCounts {
  std::optional<long> vertices;
  std::optional<long> faces;
};

/// Throws InputError where the file is missing, empty, of an unknown format, cut short or
/// inconsistent in itself. Formats by extension: stl, ply, obj, off.
[[nodiscard]] MeshFileCounts check_mesh_file(const std::filesystem::path& file);

}  // namespace condyle
