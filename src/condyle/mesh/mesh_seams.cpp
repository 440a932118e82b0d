#include "condyle/mesh/mesh_seams.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "condyle/mesh/mesh_edges.h"
#include "condyle/mesh/point_tree.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

constexpr double kBeside = 0.3;  // of an edge's length
constexpr double kShort = 5;     // [mm]

/// An edge of one triangle alone.
struct Rim {
  int a, b, triangle;
  Vector3d middle, inward;  ///< unit, to the side on which the triangle lies
  double length;
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
    rims.push_back({edge.a, edge.b, edge.triangle[0], middle,
                    (to - along * along.dot(to)).normalized(), (q - p).norm()});
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

/// Does `other` run along a rim on its far side, where it passes x?
bool lies_beyond(const Rim& rim, const Rim& other, const Vector3d& x) {
  constexpr double kWithin = 0.1;  // of the length: sheets may overlap a little
  return other.triangle != rim.triangle && rim.inward.dot(other.inward) < -0.5 &&
         rim.inward.dot(x - rim.middle) < kWithin * rim.length;
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
      if (!lies_beyond(rim, seams.rims[k], all.points[points[n]])) continue;
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

/// Of vertices across a seam that lie near each other the one of the lower number stays.
void merge_across(const Seams& seams, TriangleMesh& mesh) {
  std::vector<int> merged(mesh.vertices.size());
  std::iota(merged.begin(), merged.end(), 0);
  const auto root = [&](int v) {
    for (; merged[v] != v; v = merged[v]) merged[v] = merged[merged[v]];
    return v;
  };
  for (const auto& [i, k] : seams.pairs) {
    const Rim &x = seams.rims[i], &y = seams.rims[k];
    const double near = kBeside * std::min(x.length, y.length);
    for (const int v : {x.a, x.b})
      for (const int w : {y.a, y.b}) {
        const int one = root(v), other = root(w);
        if (one != other && distance(mesh, one, other) < near)
          merged[std::max(one, other)] = std::min(one, other);
      }
  }
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
    done[rim.triangle] = any = true;
    std::sort(dividing[i].begin(), dividing[i].end());
    std::array<int, 3> whole = mesh.triangles[rim.triangle];
    while (whole[2] == rim.a || whole[2] == rim.b)
      std::rotate(whole.begin(), whole.begin() + 1, whole.end());
    if (whole[0] == rim.b) std::reverse(dividing[i].begin(), dividing[i].end());
    int from = whole[0];
    for (const auto& [t, v] : dividing[i]) {
      if (v == from) continue;
      mesh.triangles.push_back({from, v, whole[2]});
      from = v;
    }
    mesh.triangles[rim.triangle] = {from, whole[1], whole[2]};
  }
  return any;
}

}  // namespace

double seam_length(const TriangleMesh& mesh) { return find_seams(mesh).length; }

double weld_seams(TriangleMesh& mesh) {
  constexpr int kMostRounds = 8;  // a triangle may lie on several seams
  Seams seams = find_seams(mesh);
  const double length = seams.length;
  if (length < kShort) return 0;
  // Each vertex of a seam divides an edge or two.
  const std::size_t most = mesh.triangles.size() + 4 * seams.rims.size();
  merge_across(seams, mesh);
  for (int round = 0; round < kMostRounds; ++round) {
    seams = find_seams(mesh);
    if (!split_across(seams, most, mesh)) break;
  }
  return length;
}

}  // namespace condyle
