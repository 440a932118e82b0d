#include "condyle/surface/outermost_part.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

#include "condyle/mesh/mesh_measures.h"
#include "condyle/mesh/orient_mesh.h"
#include "condyle/surface/mesh_distance.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

constexpr double kLeastArea = 0.1;             // of all parts: a soup of triangles has thousands
constexpr double kLowest = 0.1, kHighest = 6;  // of a sheet over another [mm]
constexpr double kAlong = 0.7;                 // cosine of the way there and the normal
constexpr double kCovered = 0.4;               // of the vertices
constexpr std::size_t kVertices = 400;         // that are looked at, about

/// A linked part.
struct Part {
  TriangleMesh mesh;
  int number;
};

std::vector<Part> large_parts(const TriangleMesh& mesh, const std::vector<int>& component) {
  const int count = 1 + *std::max_element(component.begin(), component.end());
  std::vector<double> areas(static_cast<std::size_t>(count), 0);
  for (std::size_t t = 0; t < component.size(); ++t)
    areas[component[t]] += triangle_area(mesh, mesh.triangles[t]).norm();
  const double least = kLeastArea * std::accumulate(areas.begin(), areas.end(), 0.0);
  std::vector<Part> parts;
  for (int k = 0; k < count; ++k) {
    if (k > 0 && areas[k] < least) continue;
    std::vector<bool> of_part(component.size());
    for (std::size_t t = 0; t < of_part.size(); ++t) of_part[t] = component[t] == k;
    parts.push_back({sub_mesh(mesh, of_part).mesh, k});
  }
  return parts;
}

/// How far a sheet lies over another one in the middle of what it covers of that; 0 where it does not [mm].
double height_over(const TriangleMesh& sheet, const TriangleMesh& lower) {
  const MeshDistance distance(sheet);
  const std::vector<Vector3d> normals = vertex_normals(lower);
  const std::size_t step = std::max<std::size_t>(1, lower.vertices.size() / kVertices);
  std::vector<double> heights;
  std::size_t looked_at = 0;
  for (std::size_t i = 0; i < lower.vertices.size(); i += step) {
    ++looked_at;
    const Vector3d way = distance.closest(lower.vertices[i]) - lower.vertices[i];
    const double height = way.norm();
    if (height > kLowest && height < kHighest && way.dot(normals[i]) > kAlong * height)
      heights.push_back(height);
  }
  if (static_cast<double>(heights.size()) < kCovered * static_cast<double>(looked_at)) return 0;
  const auto middle = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 2);
  std::nth_element(heights.begin(), middle, heights.end());
  return *middle;
}

}  // namespace

OutermostPart outermost_part(const TriangleMesh& mesh, const std::vector<bool>& keep) {
  OutermostPart result{std::vector<bool>(keep.size(), false)};
  const SubMesh all = sub_mesh(mesh, keep);
  if (all.mesh.triangles.empty()) return result;
  const std::vector<int> component = find_components(all.mesh, TriangleLinks(all.mesh));
  const std::vector<Part> parts = large_parts(all.mesh, component);
  std::size_t chosen = 0;
  const auto height = [&](std::size_t upper, std::size_t lower) {
    return upper == lower ? 0 : height_over(parts[upper].mesh, parts[lower].mesh);
  };
  const auto covers = [&](std::size_t k) {
    return height(k, chosen) > 0 && height(chosen, k) == 0;
  };
  for (std::size_t round = 1, last = 0; round < parts.size(); ++round, last = chosen) {
    for (std::size_t k = 0; k < parts.size() && chosen == last; ++k)
      if (covers(k)) chosen = k;
    if (chosen == last) break;
  }
  for (std::size_t k = 0; k < parts.size(); ++k)
    result.below = std::max(result.below, height(chosen, k));
  for (std::size_t t = 0, k = 0; t < keep.size(); ++t)
    if (keep[t]) result.keep[t] = component[k++] == parts[chosen].number;
  return result;
}

}  // namespace condyle
