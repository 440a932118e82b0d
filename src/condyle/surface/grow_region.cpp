#include "condyle/surface/grow_region.h"

#include <limits>
#include <queue>

#include "condyle/mesh/mesh_edges.h"

namespace condyle {
namespace {

struct Edge {
  int to;
  double length;  ///< [mm]
};

/// The edges that leave each vertex.
std::vector<std::vector<Edge>> edges_of_vertices(const TriangleMesh& mesh) {
  std::vector<std::vector<Edge>> edges(mesh.vertices.size());
  for (const MeshEdge& e : mesh_edges(mesh)) {
    const double length = (mesh.vertices[e.a] - mesh.vertices[e.b]).norm();
    edges[e.a].push_back({e.b, length});
    edges[e.b].push_back({e.a, length});
  }
  return edges;
}

}  // namespace

std::vector<bool> grow_region(const TriangleMesh& mesh,
                              const std::vector<bool>& keep,
                              const std::vector<bool>& may,
                              double distance) {
  if (!(distance > 0)) return keep;
  const std::vector<std::vector<Edge>> edges = edges_of_vertices(mesh);
  std::vector<double> way(mesh.vertices.size(), std::numeric_limits<double>::infinity());
  // [Dijkstra 1959] The nearest first.
  using Reached = std::pair<double, int>;
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> front;
  for (std::size_t t = 0; t < keep.size(); ++t)
    if (keep[t])
      for (const int v : mesh.triangles[t])
        if (way[v] > 0) front.emplace(way[v] = 0, v);
  while (!front.empty()) {
    const auto [so_far, v] = front.top();
    front.pop();
    if (so_far > way[v]) continue;
    for (const auto& [to, length] : edges[v]) {
      const double there = so_far + length;
      if (!may[to] || there > distance || there >= way[to]) continue;
      front.emplace(way[to] = there, to);
    }
  }
  std::vector<bool> grown = keep;
  for (std::size_t t = 0; t < keep.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    grown[t] = keep[t] || (way[a] <= distance && way[b] <= distance && way[c] <= distance);
  }
  return grown;
}

}  // namespace condyle
