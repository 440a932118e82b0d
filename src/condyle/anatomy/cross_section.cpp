#include "condyle/anatomy/cross_section.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "condyle/math/disjoint_sets.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

/// Where the plane cuts an edge of the mesh, once for both triangles there.
struct Cuts {
  std::unordered_map<std::uint64_t, int> index;
  std::vector<Vector3d> points;
  DisjointSets loops;
};

int cut_edge(
    Cuts& cuts, const TriangleMesh& mesh, const std::vector<double>& height, int a, int b) {
  if (a > b) std::swap(a, b);
  const std::uint64_t key = static_cast<std::uint64_t>(a) << 32 | static_cast<std::uint64_t>(b);
  const auto [found, is_new] = cuts.index.try_emplace(key, static_cast<int>(cuts.points.size()));
  if (is_new) {
    const double share = height[a] / (height[a] - height[b]);
    cuts.points.emplace_back(mesh.vertices[a] + share * (mesh.vertices[b] - mesh.vertices[a]));
    cuts.loops.add();
  }
  return found->second;
}

/// A piece of an outline, bone on its left when seen against `along`.
struct Segment {
  int from, to;
};

std::vector<Segment> cut_triangles(Cuts& cuts,
                                   const TriangleMesh& mesh,
                                   const std::vector<double>& height) {
  std::vector<Segment> segments;
  for (const auto& t : mesh.triangles) {
    int from = -1, to = -1;
    for (int k = 0; k < 3; ++k) {
      const int a = t[k], b = t[(k + 1) % 3];
      if ((height[a] >= 0) == (height[b] >= 0)) continue;
      (height[a] >= 0 ? to : from) = cut_edge(cuts, mesh, height, a, b);
    }
    if (from < 0) continue;
    segments.push_back({to, from});
    cuts.loops.join(from, to);
  }
  return segments;
}

}  // namespace

std::vector<SectionLoop> cross_section(const TriangleMesh& mesh,
                                       const Vector3d& at,
                                       const Vector3d& along) {
  std::vector<double> height(mesh.vertices.size());
  for (std::size_t i = 0; i < height.size(); ++i) height[i] = along.dot(mesh.vertices[i] - at);
  Cuts cuts;
  const std::vector<Segment> segments = cut_triangles(cuts, mesh, height);
  std::vector<SectionLoop> loops(cuts.points.size(), {.centroid = Vector3d::Zero()});
  std::vector<Vector3d> run(cuts.points.size(), Vector3d::Zero());  // from end to end
  for (const Segment& s : segments) {
    const int loop = cuts.loops.root(s.from);
    const Vector3d& start = cuts.points[loop];
    const Vector3d a = cuts.points[s.from] - start, b = cuts.points[s.to] - start;
    const double area = along.dot(a.cross(b)) / 2;
    loops[loop].area += area;
    loops[loop].centroid += area * (a + b) / 3;
    loops[loop].length += (b - a).norm();
    run[loop] += b - a;
  }
  std::vector<SectionLoop> found;
  for (std::size_t i = 0; i < loops.size(); ++i) {
    if (loops[i].area == 0) continue;
    loops[i].centroid = cuts.points[i] + loops[i].centroid / loops[i].area;
    loops[i].opening = run[i].norm();
    found.push_back(loops[i]);
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const SectionLoop& a, const SectionLoop& b) { return a.area > b.area; });
  return found;
}

}  // namespace condyle
