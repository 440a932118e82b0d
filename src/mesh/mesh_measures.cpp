#include "mesh/mesh_measures.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cassert>
#include <tuple>

namespace condyle {

using Eigen::Vector3d;

std::vector<Vector3d> triangle_areas(const TriangleMesh& mesh) {
  std::vector<Vector3d> areas;
  areas.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vector3d& p = mesh.vertices[a];
    areas.push_back(0.5 * (mesh.vertices[b] - p).cross(mesh.vertices[c] - p));
  }
  return areas;
}

std::vector<Vector3d> vertex_normals(const TriangleMesh& mesh) {
  std::vector<Vector3d> normals(mesh.vertices.size(), Vector3d::Zero());
  const std::vector<Vector3d> areas = triangle_areas(mesh);
  for (std::size_t t = 0; t < areas.size(); ++t)
    for (const int v : mesh.triangles[t]) normals[v] += areas[t];
  for (Vector3d& n : normals) n = n.stableNormalized();
  return normals;
}

std::vector<double> vertex_areas(const TriangleMesh& mesh) {
  std::vector<double> result(mesh.vertices.size(), 0.0);
  const std::vector<Vector3d> areas = triangle_areas(mesh);
  for (std::size_t t = 0; t < areas.size(); ++t)
    for (const int v : mesh.triangles[t]) result[v] += areas[t].norm() / 3;
  return result;
}

std::vector<MeshEdge> mesh_edges(const TriangleMesh& mesh) {
  struct HalfEdge {
    int a, b, triangle;
    bool forward;
  };
  std::vector<HalfEdge> halves;
  halves.reserve(3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const int from = mesh.triangles[t][k], to = mesh.triangles[t][(k + 1) % 3];
      halves.push_back({std::min(from, to), std::max(from, to), static_cast<int>(t), from < to});
    }
  std::sort(halves.begin(), halves.end(), [](const HalfEdge& x, const HalfEdge& y) {
    return std::tie(x.a, x.b, x.triangle) < std::tie(y.a, y.b, y.triangle);
  });
  std::vector<MeshEdge> edges;
  edges.reserve(halves.size() / 2);
  for (const HalfEdge& h : halves) {
    if (edges.empty() || edges.back().a != h.a || edges.back().b != h.b) {
      edges.emplace_back();
      edges.back().a = h.a;
      edges.back().b = h.b;
    }
    MeshEdge& edge = edges.back();
    if (edge.count < 2) {
      edge.triangle[edge.count] = h.triangle;
      edge.forward[edge.count] = h.forward;
    }
    ++edge.count;
  }
  return edges;
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
