#include "condyle/mesh/mesh_edges.h"

#include <algorithm>

namespace condyle {
namespace {

/// A side of a triangle, seen from the lesser of its two vertices.
struct HalfEdge {
  int other;  ///< the greater vertex
  int side;   ///< three times the triangle, plus the number of the side
  bool operator<(const HalfEdge& x) const {
    return other != x.other ? other < x.other : side < x.side;
  }
};

struct Ends {
  int from, to;
};
Ends ends_of(const TriangleMesh& mesh, int side) {
  const std::array<int, 3>& t = mesh.triangles[side / 3];
  return {t[side % 3], t[(side + 1) % 3]};
}

/// Sides of all triangles, in the order of the lesser vertex: those of vertex v are
/// [begin[v], begin[v + 1]).
struct SidesByVertex {
  std::vector<int> begin, sides;

  explicit SidesByVertex(const TriangleMesh& mesh)
      : begin(mesh.vertices.size() + 2, 0), sides(3 * mesh.triangles.size()) {
    const int n = static_cast<int>(sides.size());
    const auto lesser = [&mesh](int side) {
      const Ends e = ends_of(mesh, side);
      return std::min(e.from, e.to);
    };
    // Counted two places on, so that filling moves each beginning to where it belongs.
    for (int side = 0; side < n; ++side) ++begin[lesser(side) + 2];
    for (std::size_t v = 2; v < begin.size(); ++v) begin[v] += begin[v - 1];
    for (int side = 0; side < n; ++side) sides[begin[lesser(side) + 1]++] = side;
  }
};

/// Calls visit(a, first, last) for each edge, in the order of its vertices: the half edges
/// [first, last) of one edge from a, by rising triangle.
template <class Visit>
void for_each_edge(const TriangleMesh& mesh, Visit visit) {
  const SidesByVertex by_vertex(mesh);
  std::vector<HalfEdge> around;
  for (int a = 0; a < static_cast<int>(mesh.vertices.size()); ++a) {
    around.clear();
    for (int i = by_vertex.begin[a]; i < by_vertex.begin[a + 1]; ++i) {
      const int side = by_vertex.sides[i];
      const Ends e = ends_of(mesh, side);
      around.push_back({std::max(e.from, e.to), side});
    }
    std::sort(around.begin(), around.end());
    for (auto first = around.begin(); first != around.end();) {
      auto last = first;
      while (last != around.end() && last->other == first->other) ++last;
      visit(a, first, last);
      first = last;
    }
  }
}

}  // namespace

std::vector<MeshEdge> mesh_edges(const TriangleMesh& mesh) {
  std::vector<MeshEdge> edges;
  edges.reserve(3 * mesh.triangles.size() / 2 + 16);
  for_each_edge(mesh, [&](int a, auto first, auto last) {
    MeshEdge edge{.a = a, .b = first->other, .count = static_cast<int>(last - first)};
    for (int k = 0; k < std::min(edge.count, 2); ++k) {
      edge.triangle[k] = first[k].side / 3;
      edge.forward[k] = ends_of(mesh, first[k].side).from == a;
    }
    edges.push_back(edge);
  });
  return edges;
}

TriangleLinks::TriangleLinks(const TriangleMesh& mesh) : links_(mesh.triangles.size()) {
  for_each_edge(mesh, [&](int a, auto first, auto last) {
    const auto link = [this](const HalfEdge& h) -> int& { return links_[h.side / 3][h.side % 3]; };
    if (last - first == 2) {
      const bool agrees =
          (ends_of(mesh, first[0].side).from == a) != (ends_of(mesh, first[1].side).from == a);
      link(first[0]) = 2 * (first[1].side / 3) + agrees;
      link(first[1]) = 2 * (first[0].side / 3) + agrees;
      return;
    }
    const bool boundary = last - first == 1;
    ++(boundary ? boundary_edges_ : non_manifold_edges_);
    for (auto h = first; h != last; ++h) link(*h) = boundary ? kBoundary : kNonManifold;
  });
}

}  // namespace condyle
