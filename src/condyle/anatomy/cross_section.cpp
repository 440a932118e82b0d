#include "condyle/anatomy/cross_section.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>
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

/// Where triangles are missing the line has an end, and goes on a little farther.
std::vector<Segment> bridges(const Cuts& cuts, const std::vector<Segment>& segments) {
  constexpr double kLongest = 5;  // [mm]
  std::vector<int> leaves(cuts.points.size(), 0), arrives(cuts.points.size(), 0);
  for (const Segment& s : segments) ++leaves[s.from], ++arrives[s.to];
  std::vector<int> ends, starts;
  for (int i = 0; i < static_cast<int>(cuts.points.size()); ++i) {
    if (leaves[i] == 0 && arrives[i] > 0) ends.push_back(i);
    if (arrives[i] == 0 && leaves[i] > 0) starts.push_back(i);
  }
  std::vector<std::tuple<double, int, int>> near;
  for (const int end : ends)
    for (const int start : starts)
      if (const double way = (cuts.points[start] - cuts.points[end]).norm(); way < kLongest)
        near.emplace_back(way, end, start);
  std::sort(near.begin(), near.end());
  std::vector<Segment> found;
  for (const auto& [way, end, start] : near) {
    if (leaves[end]++ > 0 || arrives[start]++ > 0) continue;
    found.push_back({end, start});
  }
  return found;
}

}  // namespace

std::vector<SectionLoop> cross_section(const TriangleMesh& mesh,
                                       const Vector3d& at,
                                       const Vector3d& along) {
  std::vector<double> height(mesh.vertices.size());
  for (std::size_t i = 0; i < height.size(); ++i) height[i] = along.dot(mesh.vertices[i] - at);
  Cuts cuts;
  std::vector<Segment> segments = cut_triangles(cuts, mesh, height);
  const std::vector<Segment> bridged = bridges(cuts, segments);
  for (const Segment& s : bridged) cuts.loops.join(s.from, s.to);
  segments.insert(segments.end(), bridged.begin(), bridged.end());
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
  for (const Segment& s : bridged)
    loops[cuts.loops.root(s.from)].opening += (cuts.points[s.to] - cuts.points[s.from]).norm();
  std::vector<SectionLoop> found;
  for (std::size_t i = 0; i < loops.size(); ++i) {
    if (loops[i].area == 0) continue;
    loops[i].centroid = cuts.points[i] + loops[i].centroid / loops[i].area;
    loops[i].opening += run[i].norm();
    found.push_back(loops[i]);
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const SectionLoop& a, const SectionLoop& b) { return a.area > b.area; });
  return found;
}

}  // namespace condyle
