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

/// The numbers of the linked parts that may be sheets; the largest comes first.
std::vector<int> large_parts(const TriangleMesh& mesh, const std::vector<int>& component) {
  const int count = 1 + *std::max_element(component.begin(), component.end());
  std::vector<double> areas(static_cast<std::size_t>(count), 0);
  for (std::size_t t = 0; t < component.size(); ++t)
    areas[component[t]] += triangle_area(mesh, mesh.triangles[t]).norm();
  const double least = kLeastArea * std::accumulate(areas.begin(), areas.end(), 0.0);
  std::vector<int> numbers;
  for (int k = 0; k < count; ++k)
    if (k == 0 || areas[k] >= least) numbers.push_back(k);
  return numbers;
}

TriangleMesh part_of(const TriangleMesh& mesh, const std::vector<int>& component, int number) {
  std::vector<bool> keep(component.size());
  for (std::size_t t = 0; t < keep.size(); ++t) keep[t] = component[t] == number;
  return sub_mesh(mesh, keep).mesh;
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

/// The heights of each sheet over each other one [mm].
Eigen::MatrixXd heights_of(const std::vector<TriangleMesh>& sheets) {
  const auto count = static_cast<Eigen::Index>(sheets.size());
  Eigen::MatrixXd heights = Eigen::MatrixXd::Zero(count, count);
  for (Eigen::Index upper = 0; upper < count; ++upper)
    for (Eigen::Index lower = 0; lower < count; ++lower)
      if (upper != lower) heights(upper, lower) = height_over(sheets[upper], sheets[lower]);
  return heights;
}

/// From the first sheet to one that covers it, and on.
Eigen::Index outermost(const Eigen::MatrixXd& heights) {
  Eigen::Index chosen = 0;
  for (Eigen::Index round = 1, last = 0; round < heights.rows(); ++round, last = chosen) {
    for (Eigen::Index k = 0; k < heights.rows() && chosen == last; ++k)
      if (heights(k, last) > 0 && heights(last, k) == 0) chosen = k;
    if (chosen == last) break;
  }
  return chosen;
}

}  // namespace

OutermostPart outermost_part(const TriangleMesh& mesh, const std::vector<bool>& keep) {
  OutermostPart result{std::vector<bool>(keep.size(), false)};
  const SubMesh all = sub_mesh(mesh, keep);
  if (all.mesh.triangles.empty()) return result;
  const std::vector<int> component = find_components(all.mesh, TriangleLinks(all.mesh));
  const std::vector<int> numbers = large_parts(all.mesh, component);
  int number = numbers.front();
  if (numbers.size() > 1) {
    std::vector<TriangleMesh> sheets;
    for (const int k : numbers) sheets.push_back(part_of(all.mesh, component, k));
    const Eigen::MatrixXd heights = heights_of(sheets);
    const Eigen::Index chosen = outermost(heights);
    number = numbers[static_cast<std::size_t>(chosen)];
    result.below = heights.row(chosen).maxCoeff();
  }
  for (std::size_t t = 0, k = 0; t < keep.size(); ++t)
    if (keep[t]) result.keep[t] = component[k++] == number;
  return result;
}

}  // namespace condyle
