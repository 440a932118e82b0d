#pragma once

/// Binary STL: the same mesh always gives the same bytes.

#include <string>

#include "condyle/mesh/triangle_mesh.h"

namespace condyle::phantom {

/// The file's content. The title is cut to the 80 bytes of the header.
[[nodiscard]] std::string binary_stl(const TriangleMesh& mesh, const std::string& title);

}  // namespace condyle::phantom
