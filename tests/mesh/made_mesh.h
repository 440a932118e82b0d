#pragma once

/// Made-up meshes and the files of them: plain writers of STL, PLY, OBJ and OFF with the freedom
/// that each format leaves.

#include <Eigen/Geometry>

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "condyle/mesh/triangle_mesh.h"

namespace condyle::test {

struct Random : std::mt19937_64 {
  using std::mt19937_64::mt19937_64;
  bool plain = false;  ///< files use only what every program reads alike
};
inline int pick(Random& random, int least, int greatest) {
  return std::uniform_int_distribution<int>(least, greatest)(random);
}
inline bool coin(Random& random) { return pick(random, 0, 1) != 0; }
template <class T>
const T& one_of(Random& random, const std::vector<T>& choices) {
  return choices[pick(random, 0, static_cast<int>(choices.size()) - 1)];
}

/// Polygons over vertices, as a file holds them.
struct MadeMesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::vector<int>> faces;
};

/// A file, and the mesh that a reader should make of it.
struct MadeFile {
  std::string bytes;
  MadeMesh mesh;
  bool tells_its_end = true;  ///< by counts or a last word: OBJ does not, nor do several solids
};

/// Random vertices, and faces of three to six of them.
enum class Numbers { kWhole, kFloat, kDouble };
[[nodiscard]] MadeMesh make_mesh(Random& random, Numbers numbers, bool triangles_only);

[[nodiscard]] MadeFile make_stl(Random& random);
[[nodiscard]] MadeFile make_ply(Random& random);
[[nodiscard]] MadeFile make_obj(Random& random);
[[nodiscard]] MadeFile make_off(Random& random);

/// Why the mesh is not that of the file; empty where it is: vertices equal to the bit, as many
/// triangles as the faces make, the same vector area and area of triangles.
[[nodiscard]] std::string difference(const TriangleMesh& mesh, const MadeMesh& expected);

}  // namespace condyle::test
