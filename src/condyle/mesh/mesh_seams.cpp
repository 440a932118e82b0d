#include "condyle/mesh/mesh_seams.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "condyle/mesh/mesh_edges.h"
#include "condyle/mesh/mesh_measures.h"
#include "condyle/mesh/point_tree.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

constexpr double kBeside = 0.3;  // of an edge's length
constexpr double kShort = 4;     // in mean edges, as slits of pinholes are

/// An edge of one triangle alone.
struct Rim {
  int a, b, triangle;
  Vector3d middle, inward;  ///< unit, to the side on which the triangle lies
  double length, height;    ///< of the triangle over it
};

std::vector<Rim> rims_of(const TriangleMesh& mesh) {
  std::vector<Rim> rims;
  for (const MeshEdge& edge : mesh_edges(mesh)) {
    if (edge.count != 1) continue;
    const Vector3d &p = mesh.vertices[edge.a], &q = mesh.vertices[edge.b];
    Vector3d third = Vector3d::Zero();
    for (const int v : mesh.triangles[edge.triangle[0]])
      if (v != edge.a && v != edge.b) third = mesh.vertices[v];
    const Vector3d along = (q - p).normalized(), middle = 0.5 * (p + q), to = third - middle;
    const Vector3d over = to - along * along.dot(to);
    rims.push_back(
        {edge.a, edge.b, edge.triangle[0], middle, over.normalized(), (q - p).norm(), over.norm()});
  }
  return rims;
}

/// Points on the edges, about as close as what counts as beside one of middling length, and whose they are.
struct RimPoints {
  std::vector<Vector3d> points;
  std::vector<std::size_t> rim;

  RimPoints(const TriangleMesh& mesh, const std::vector<Rim>& rims) {
    std::vector<double> lengths;
    for (const Rim& one : rims) lengths.push_back(one.length);
    const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
    std::nth_element(lengths.begin(), middle, lengths.end());
    for (std::size_t i = 0; i < rims.size(); ++i) {
      constexpr double kMost = 64;
      const double wanted = std::ceil(rims[i].length / (kBeside * std::max(*middle, 1e-300)));
      const int parts = 1 + static_cast<int>(std::min(kMost, wanted));
      const Vector3d &p = mesh.vertices[rims[i].a], &q = mesh.vertices[rims[i].b];
      for (int k = 0; k <= parts; ++k) {
        points.emplace_back(p + (q - p) * k / parts);
        rim.push_back(i);
      }
    }
  }
};

/// Do two edges with a common vertex lie on one another? An outline has notches, of which the sides gape.
bool gape(const TriangleMesh& mesh, const Rim& x, const Rim& y) {
  constexpr double kOnOneAnother = 0.15;  // [rad]
  const int common = x.a == y.a || x.a == y.b ? x.a : x.b == y.a || x.b == y.b ? x.b : -1;
  if (common < 0) return false;
  const auto way = [&](const Rim& rim) {
    return (mesh.vertices[rim.a == common ? rim.b : rim.a] - mesh.vertices[common]) / rim.length;
  };
  return !((way(x) - way(y)).norm() < kOnOneAnother);
}

/// Does `other` run along a rim on its far side, where it passes x?
bool lies_beyond(const TriangleMesh& mesh, const Rim& rim, const Rim& other, const Vector3d& x) {
  constexpr double kWithin = 0.1;  // of what the triangle covers: sheets may overlap a little
  return other.triangle != rim.triangle && rim.inward.dot(other.inward) < -0.5 &&
         rim.inward.dot(x - rim.middle) < kWithin * std::min(rim.length, rim.height) &&
         !gape(mesh, rim, other);
}

struct Seams {
  std::vector<Rim> rims;
  std::vector<std::pair<std::size_t, std::size_t>>
      pairs;          ///< of rims on either side, in rising order
  double length = 0;  ///< [mm]
};

Seams find_seams(const TriangleMesh& mesh) {
  constexpr std::size_t kNearest = 32;  // points
  Seams seams{rims_of(mesh), {}, 0};
  if (seams.rims.empty()) return seams;
  const RimPoints all(mesh, seams.rims);
  const PointCloud cloud{all.points};
  PointTree tree(3, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(16));
  for (std::size_t i = 0; i < seams.rims.size(); ++i) {
    const Rim& rim = seams.rims[i];
    const double reach = kBeside * rim.length;
    // Those of one edge beside another are among the nearest; a hostile mesh has any number within reach.
    std::array<std::size_t, kNearest> points;
    std::array<double, kNearest> squares;
    nanoflann::KNNResultSet<double> found(kNearest);
    found.init(points.data(), squares.data());
    tree.findNeighbors(found, rim.middle.data(), nanoflann::SearchParams());
    bool beside = false;
    for (std::size_t n = 0; n < found.size() && squares[n] < reach * reach; ++n) {
      const std::size_t k = all.rim[points[n]];
      if (!lies_beyond(mesh, rim, seams.rims[k], all.points[points[n]])) continue;
      beside = true;
      seams.pairs.push_back(std::minmax(i, k));
    }
    if (beside) seams.length += rim.length / 2;  // either side counts half
  }
  std::sort(seams.pairs.begin(), seams.pairs.end());
  seams.pairs.erase(std::unique(seams.pairs.begin(), seams.pairs.end()), seams.pairs.end());
  return seams;
}

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
        const double near = kBeside * std::min({x.length, y.length, rooms[v], rooms[w]});
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
  return off < kBeside * rim.length && t > kEnd && t < 1 - kEnd ? t : 0;
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

double seam_length(const TriangleMesh& mesh) { return find_seams(mesh).length; }

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

}  // namespace condyle
