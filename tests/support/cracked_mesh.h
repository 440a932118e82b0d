#pragma once

/// A mesh as a tool leaves it that writes the parts of a bone one by one.

#include "condyle/mesh/mesh_measures.h"
#include "condyle/mesh/triangle_mesh.h"

namespace condyle::test {

/// Triangles whose middles lie below `z` have vertices of their own, moved down by `width`: a crack all the way round.
inline TriangleMesh cracked(TriangleMesh mesh, double z, double width) {
  const std::size_t count = mesh.vertices.size();
  for (std::size_t i = 0; i < count; ++i)
    mesh.vertices.emplace_back(mesh.vertices[i] - Eigen::Vector3d(0, 0, width));
  for (auto& triangle : mesh.triangles)
    if (triangle_middle(mesh, triangle).z() < z)
      for (int& v : triangle) v += static_cast<int>(count);
  return mesh;
}

}  // namespace condyle::test
