#include "condyle/mesh/main_parts.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <numeric>
#include <vector>

#include "condyle/mesh/mesh_measures.h"
#include "condyle/mesh/orient_mesh.h"

namespace condyle {
namespace {

constexpr double kLeastOfLargest = 0.2, kLeastOfAll = 0.8;

}  // namespace

MainParts main_parts(const TriangleMesh& mesh) {
  const std::vector<int> component = find_components(mesh, TriangleLinks(mesh));
  std::vector<double> areas;
  std::vector<Eigen::AlignedBox3d> boxes;
  for (std::size_t t = 0; t < component.size(); ++t) {
    const auto k = static_cast<std::size_t>(component[t]);
    if (k >= areas.size()) areas.resize(k + 1, 0), boxes.resize(k + 1);
    areas[k] += triangle_area(mesh, mesh.triangles[t]).norm();
    for (const int v : mesh.triangles[t]) boxes[k].extend(mesh.vertices[v]);
  }
  const auto is_main = [&](std::size_t k) { return areas[k] >= kLeastOfLargest * areas[0]; };
  double kept = 0;
  MainParts parts;
  for (std::size_t k = areas.size(); k-- > 0;) {
    if (is_main(k)) {
      kept += areas[k];
      continue;
    }
    ++parts.left_out;
    parts.middle = boxes[k].center();
    parts.size = boxes[k].sizes();
  }
  const double all = std::accumulate(areas.begin(), areas.end(), 0.0);
  if (parts.left_out == 0 || !(kept >= kLeastOfAll * all)) return {mesh};
  std::vector<bool> keep(component.size());
  for (std::size_t t = 0; t < keep.size(); ++t)
    keep[t] = is_main(static_cast<std::size_t>(component[t]));
  parts.mesh = sub_mesh(mesh, keep).mesh;
  return parts;
}

}  // namespace condyle
