#include "phantom/split_triangles.h"

#include <utility>

#include "condyle/mesh/mesh_measures.h"

namespace condyle::phantom {
namespace {

TriangleMesh split_once(TriangleMesh mesh) {
  std::vector<std::array<int, 3>> middles(mesh.triangles.size());
  for (const MeshEdge& e : mesh_edges(mesh)) {
    const int middle = static_cast<int>(mesh.vertices.size());
    mesh.vertices.push_back((mesh.vertices[e.a] + mesh.vertices[e.b]) / 2);
    for (const int t : e.triangle)
      for (int k = 0; t >= 0 && k < 3; ++k) {
        const int from = mesh.triangles[t][k], to = mesh.triangles[t][(k + 1) % 3];
        if (std::minmax(from, to) == std::pair<const int&, const int&>(e.a, e.b))
          middles[t][k] = middle;
      }
  }
  std::vector<std::array<int, 3>> fine;
  fine.reserve(4 * mesh.triangles.size());
  for (std::size_t t = 0; t < middles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const auto& [ab, bc, ca] = middles[t];
    for (const std::array<int, 3>& part : {std::array{a, ab, ca}, std::array{ab, b, bc},
                                           std::array{ca, bc, c}, std::array{ab, bc, ca}})
      fine.push_back(part);
  }
  mesh.triangles = std::move(fine);
  return mesh;
}

}  // namespace

TriangleMesh split_triangles(TriangleMesh mesh, int times) {
  for (int i = 0; i < times; ++i) mesh = split_once(std::move(mesh));
  return mesh;
}

}  // namespace condyle::phantom
