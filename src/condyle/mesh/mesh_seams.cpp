#include "condyle/mesh/mesh_seams.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "condyle/mesh/mesh_edges.h"
#include "condyle/mesh/point_tree.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

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
      const double wanted = std::ceil(rims[i].length / (kBesideRim * std::max(*middle, 1e-300)));
      const int parts = 1 + static_cast<int>(std::min(kMost, wanted));
      const Vector3d &p = mesh.vertices[rims[i].a], &q = mesh.vertices[rims[i].b];
      for (int k = 0; k <= parts; ++k) {
        points.emplace_back(p + (q - p) * k / parts);
        rim.push_back(i);
      }
    }
  }
};

/// Do two edges with a common vertex part there, as the sides of a notch in an outline do?
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

}  // namespace

Seams find_seams(const TriangleMesh& mesh) {
  constexpr std::size_t kNearest = 32;  // points
  Seams seams{rims_of(mesh), {}, 0};
  if (seams.rims.empty()) return seams;
  const RimPoints all(mesh, seams.rims);
  const PointCloud cloud{all.points};
  PointTree tree(3, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(16));
  for (std::size_t i = 0; i < seams.rims.size(); ++i) {
    const Rim& rim = seams.rims[i];
    const double reach = kBesideRim * rim.length;
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

}  // namespace condyle
