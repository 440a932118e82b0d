#pragma once

/// assimp lives here and nowhere else.

#include <string>
#include <vector>

namespace condyle {

/// A mesh as assimp holds it: single precision, three numbers a vertex, three indices a triangle.
struct ImportedMesh {
  std::vector<float> coordinates;
  std::vector<int> corners;
};

[[nodiscard]] bool assimp_knows(const std::string& ending);

/// Throws std::exception where assimp does not read the file. May do anything at all on a damaged
/// one: to be called where that does no harm (isolated_import.h).
[[nodiscard]] ImportedMesh import_with_assimp(const std::string& file);

}  // namespace condyle
