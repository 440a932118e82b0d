#include "condyle/mesh/mesh_measures.h"

#include <Eigen/Geometry>

#include <cassert>

namespace condyle {

using Eigen::Vector3d;

Vector3d triangle_area(const TriangleMesh& mesh, const std::array<int, 3>& triangle) {
  const Vector3d& p = mesh.vertices[triangle[0]];
  return 0.5 * (mesh.vertices[triangle[1]] - p).cross(mesh.vertices[triangle[2]] - p);
}

Vector3d triangle_middle(const TriangleMesh& mesh, const std::array<int, 3>& triangle) {
  const auto& [a, b, c] = triangle;
  return (mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]) / 3;
}

Eigen::AlignedBox3d box_of_triangles(const TriangleMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const auto& triangle : mesh.triangles)
    for (const int v : triangle) box.extend(mesh.vertices[v]);
  return box;
}

std::vector<Vector3d> triangle_areas(const TriangleMesh& mesh) {
  std::vector<Vector3d> areas;
  areas.reserve(mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) areas.push_back(triangle_area(mesh, triangle));
  return areas;
}

std::vector<Vector3d> vertex_normals(const TriangleMesh& mesh) {
  std::vector<Vector3d> normals(mesh.vertices.size(), Vector3d::Zero());
  for (const auto& triangle : mesh.triangles) {
    const Vector3d area = triangle_area(mesh, triangle);
    for (const int v : triangle) normals[v] += area;
  }
  for (Vector3d& n : normals) n = n.stableNormalized();
  return normals;
}

std::vector<double> vertex_areas(const TriangleMesh& mesh) {
  std::vector<double> result(mesh.vertices.size(), 0.0);
  for (const auto& triangle : mesh.triangles) {
    const double area = triangle_area(mesh, triangle).norm();
    for (const int v : triangle) result[v] += area / 3;
  }
  return result;
}

double mean_edge_length(const TriangleMesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k)
      sum += (mesh.vertices[t[k]] - mesh.vertices[t[(k + 1) % 3]]).norm();
  return mesh.triangles.empty() ? 0 : sum / (3 * static_cast<double>(mesh.triangles.size()));
}

SubMesh sub_mesh(const TriangleMesh& mesh, const std::vector<bool>& keep) {
  assert(keep.size() == mesh.triangles.size());
  SubMesh result;
  std::vector<int> new_index(mesh.vertices.size(), -1);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!keep[t]) continue;
    std::array<int, 3> triangle{};
    for (std::size_t k = 0; k < 3; ++k) {
      const int old = mesh.triangles[t][k];
      if (new_index[old] < 0) {
        new_index[old] = static_cast<int>(result.old_index.size());
        result.old_index.push_back(old);
        result.mesh.vertices.push_back(mesh.vertices[old]);
      }
      triangle[k] = new_index[old];
    }
    result.mesh.triangles.push_back(triangle);
  }
  return result;
}

}  // namespace condyle
