#include "condyle/anatomy/surface_samples.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "condyle/math/disjoint_sets.h"
#include "condyle/mesh/mesh_measures.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

/// Of each vertex, the lowest vertex that it is linked to through triangles.
std::vector<int> connected_parts(const TriangleMesh& mesh) {
  DisjointSets linked(mesh.vertices.size());
  for (const auto& t : mesh.triangles)
    for (const int v : {t[1], t[2]}) linked.join(t[0], v);
  std::vector<int> lowest(mesh.vertices.size());
  for (std::size_t v = 0; v < lowest.size(); ++v) lowest[v] = linked.root(static_cast<int>(v));
  return lowest;
}

/// The cube, and which of the six faces of a die the normal is nearest to.
std::uint64_t cell_of(const Vector3d& p, const Vector3d& normal, double spacing) {
  int axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  std::uint64_t key = 2 * static_cast<std::uint64_t>(axis) + (normal[axis] < 0 ? 1 : 0);
  for (int k = 0; k < 3; ++k) {
    const auto cube = static_cast<std::int64_t>(std::floor(p[k] / spacing)) + (1 << 19);
    key = (key << 20) | (static_cast<std::uint64_t>(cube) & 0xfffff);
  }
  return key;
}

}  // namespace

SurfaceSamples sample_surface(const TriangleMesh& mesh,
                              const std::vector<bool>& keep,
                              double spacing) {
  SurfaceSamples samples;
  samples.spacing = spacing;
  const std::vector<int> parts = connected_parts(mesh);
  std::unordered_map<std::uint64_t, std::size_t> known;
  const auto add = [&](const Vector3d& p, const Vector3d& area, double size, int part) {
    const auto [it, fresh] = known.try_emplace(cell_of(p, area, spacing), samples.points.size());
    if (fresh) {
      samples.points.emplace_back(Vector3d::Zero());
      samples.normals.emplace_back(Vector3d::Zero());
      samples.areas.push_back(0);
      samples.parts.push_back(part);
    }
    samples.points[it->second] += size * p;
    samples.normals[it->second] += area;
    samples.areas[it->second] += size;
  };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!keep[t]) continue;
    const auto& [i, j, k] = mesh.triangles[t];
    const Vector3d &a = mesh.vertices[i], &b = mesh.vertices[j], &c = mesh.vertices[k];
    const Vector3d area = triangle_area(mesh, mesh.triangles[t]);
    if (!(area.norm() > 0)) continue;
    const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    const int n = std::clamp(static_cast<int>(std::ceil(2 * longest / spacing)), 1, 200);
    const double share = 1.0 / (n * n), size = area.norm() * share;
    // Centroids of the n² triangles it is cut into, those that stand as it does and upside down.
    for (int u = 0; u < n; ++u)
      for (int v = 0; u + v < n; ++v) {
        for (int turned = 0; turned < (u + v + 1 < n ? 2 : 1); ++turned) {
          const double s = (u + (1 + turned) / 3.0) / n, w = (v + (1 + turned) / 3.0) / n;
          add(a + s * (b - a) + w * (c - a), share * area, size, parts[i]);
        }
      }
  }
  for (std::size_t s = 0; s < samples.points.size(); ++s) {
    samples.points[s] /= samples.areas[s];
    samples.normals[s].normalize();
  }
  return samples;
}

}  // namespace condyle
