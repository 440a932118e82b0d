#pragma once

/// Triangle meshes from files: STL, PLY, OBJ and OFF by plain readers (mesh_readers.h), what else
/// assimp knows by assimp, in a process of its own (isolated_import.h).

#include <filesystem>

#include "condyle/mesh/triangle_mesh.h"

namespace condyle {

/// The mesh of `file` as it stands there, its lengths times `to_mm`; polygons are cut into
/// triangles. Throws InputError where the file is missing, damaged, without faces, with coordinates
/// that are no numbers, or of a size that no knee has: larger than 2000 mm or smaller than 5 mm,
/// with the unit that is suspected.
[[nodiscard]] TriangleMesh load_mesh(const std::filesystem::path& file, double to_mm);

/// The same in whatever unit the file has, of any size.
[[nodiscard]] TriangleMesh load_mesh_of_any_unit(const std::filesystem::path& file);

}  // namespace condyle
