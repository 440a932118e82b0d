#pragma once

/// Plain readers, one for each format that knees come in: every number of the file as it stands
/// there, in double precision, and nothing that the file does not say.
///
/// All of them throw InputError in one line with the file, the line or the byte, what is there and
/// what was expected. What a file states about itself must hold: a cut, damaged or overfull file is
/// bad input, never a smaller mesh. Larger faces are cut into triangles. Lengths stay in the unit
/// of the file; every index is valid, every coordinate finite, vertices and triangles there are.

#include "condyle/mesh/triangle_mesh.h"
#include "condyle/mesh_files/mesh_bytes.h"

namespace condyle {

/// ASCII and binary STL; vertices that are equal to the bit become one (STL shares none).
[[nodiscard]] TriangleMesh read_stl(const MeshBytes& bytes);

/// ASCII and binary PLY of either byte order: x, y, z of the element vertex and the list
/// vertex_indices of the element face, of any types; all else is skipped.
[[nodiscard]] TriangleMesh read_ply(const MeshBytes& bytes);

/// Vertices and faces of a Wavefront OBJ; groups, objects, textures, normals, lines and materials
/// are skipped.
[[nodiscard]] TriangleMesh read_obj(const MeshBytes& bytes);

/// OFF with or without colours, normals and texture coordinates; not in binary, not of four
/// dimensions.
[[nodiscard]] TriangleMesh read_off(const MeshBytes& bytes);

}  // namespace condyle
