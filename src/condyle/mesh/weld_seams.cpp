#include "condyle/mesh/weld_seams.h"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "condyle/mesh/mesh_measures.h"
#include "condyle/mesh/mesh_seams.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

constexpr double kShort = 4;  // in mean edges, as slits of pinholes are

double distance(const TriangleMesh& mesh, int v, int w) {
  return (mesh.vertices[v] - mesh.vertices[w]).norm();
}

/// How far each vertex may move without turning a triangle over, its least height there [mm].
std::vector<double> rooms_of(const TriangleMesh& mesh) {
  std::vector<double> rooms(mesh.vertices.size(), std::numeric_limits<double>::infinity());
  for (const auto& t : mesh.triangles) {
    const Vector3d &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    const double height = (b - a).cross(c - a).norm() / longest;
    for (const int v : t) rooms[v] = std::min(rooms[v], height);
  }
  return rooms;
}

/// Vertices across a seam that lie near each other become one, in their middle.
void merge_across(const Seams& seams, TriangleMesh& mesh) {
  const std::vector<double> rooms = rooms_of(mesh);
  std::vector<int> merged(mesh.vertices.size());
  std::iota(merged.begin(), merged.end(), 0);
  const auto root = [&](int v) {
    for (; merged[v] != v; v = merged[v]) merged[v] = merged[merged[v]];
    return v;
  };
  for (const auto& [i, k] : seams.pairs) {
    const Rim &x = seams.rims[i], &y = seams.rims[k];
    for (const int v : {x.a, x.b})
      for (const int w : {y.a, y.b}) {
        const double near = kBesideRim * std::min({x.length, y.length, rooms[v], rooms[w]});
        const int one = root(v), other = root(w);
        if (one != other && distance(mesh, v, w) < near)
          merged[std::max(one, other)] = std::min(one, other);
      }
  }
  std::vector<Vector3d> sum(mesh.vertices.size(), Vector3d::Zero());
  std::vector<int> count(mesh.vertices.size(), 0);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const int to = root(static_cast<int>(v));
    sum[to] += mesh.vertices[v];
    ++count[to];
  }
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    if (count[v] > 1) mesh.vertices[v] = sum[v] / count[v];
  for (auto& triangle : mesh.triangles)
    for (int& v : triangle) v = root(v);
  std::erase_if(mesh.triangles,
                [](const auto& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
}

/// Where on an edge, from 0 to 1, a vertex divides it; nothing where it lies beside it or at an end.
double place_on(const TriangleMesh& mesh, const Rim& rim, int v) {
  constexpr double kEnd = 0.02;
  if (v == rim.a || v == rim.b) return 0;
  const Vector3d p = mesh.vertices[rim.a], along = mesh.vertices[rim.b] - p;
  const double t = (mesh.vertices[v] - p).dot(along) / along.squaredNorm();
  const double off = (mesh.vertices[v] - p - t * along).norm();
  return off < kBesideRim * rim.length && t > kEnd && t < 1 - kEnd ? t : 0;
}

/// Do all face as the whole did, none of them without an area?
bool agree(const TriangleMesh& mesh,
           const std::array<int, 3>& whole,
           const std::vector<std::array<int, 3>>& fan) {
  const Vector3d n = triangle_area(mesh, whole);
  return std::all_of(fan.begin(), fan.end(),
                     [&](const auto& one) { return triangle_area(mesh, one).dot(n) > 0; });
}

/// One edge of each triangle at most is divided by the vertices that lie on it across a seam; false where none is, or would
/// make more than `most` triangles.
bool split_across(const Seams& seams, std::size_t most, TriangleMesh& mesh) {
  std::vector<std::vector<std::pair<double, int>>> dividing(seams.rims.size());
  for (const auto& [i, k] : seams.pairs)
    for (const auto& [rim, other] : {std::pair{i, k}, {k, i}})
      for (const int v : {seams.rims[other].a, seams.rims[other].b})
        if (const double t = place_on(mesh, seams.rims[rim], v); t > 0)
          dividing[rim].emplace_back(t, v);
  std::vector<bool> done(mesh.triangles.size());
  bool any = false;
  for (std::size_t i = 0; i < dividing.size(); ++i) {
    const Rim& rim = seams.rims[i];
    if (dividing[i].empty() || done[rim.triangle]) continue;
    if (mesh.triangles.size() + dividing[i].size() > most) return false;
    std::sort(dividing[i].begin(), dividing[i].end());
    std::array<int, 3> whole = mesh.triangles[rim.triangle];
    while (whole[2] == rim.a || whole[2] == rim.b)
      std::rotate(whole.begin(), whole.begin() + 1, whole.end());
    if (whole[0] == rim.b) std::reverse(dividing[i].begin(), dividing[i].end());
    std::vector<std::array<int, 3>> fan;
    int from = whole[0];
    for (const auto& [t, v] : dividing[i]) {
      if (v == from) continue;
      fan.push_back({from, v, whole[2]});
      from = v;
    }
    fan.push_back({from, whole[1], whole[2]});
    if (!agree(mesh, whole, fan)) continue;
    done[rim.triangle] = any = true;
    mesh.triangles[rim.triangle] = fan.back();
    mesh.triangles.insert(mesh.triangles.end(), fan.begin(), fan.end() - 1);
  }
  return any;
}

}  // namespace

WeldedSeams weld_seams(TriangleMesh& mesh) {
  constexpr int kMostRounds = 8;  // a triangle may lie on several seams
  Seams seams = find_seams(mesh);
  WeldedSeams welded{seams.length, 0};
  if (!(seams.length > kShort * mean_edge_length(mesh))) return {};
  // Each vertex of a seam divides an edge or two.
  const std::size_t most = mesh.triangles.size() + 4 * seams.rims.size();
  merge_across(seams, mesh);
  seams = find_seams(mesh);
  for (int round = 0; round < kMostRounds && split_across(seams, most, mesh); ++round)
    seams = find_seams(mesh);
  welded.joined = std::max(0.0, welded.length - seams.length);
  return welded;
}

std::string describe(const WeldedSeams& seams, double to_mm) {
  return fmt::format(
      "seam: along {:.0f} mm the triangles on either side were not linked (a crack, or vertices on "
      "one side only), {:.0f} mm of it have been joined: look whether the mesh is what was meant",
      seams.length * to_mm, seams.joined * to_mm);
}

}  // namespace condyle
