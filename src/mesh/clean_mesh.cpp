#include "mesh/clean_mesh.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <numeric>
#include <tuple>

#include <fmt/format.h>

#include "mesh/merge_vertices.h"
#include "mesh/mesh_measures.h"
#include "mesh/orient_mesh.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

void keep_triangles(TriangleMesh& mesh, const std::vector<bool>& keep) {
  std::size_t kept = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (keep[t]) mesh.triangles[kept++] = mesh.triangles[t];
  mesh.triangles.resize(kept);
}

/// Triangles with a repeated vertex, or thinner than the merging tolerance.
int drop_degenerate(TriangleMesh& mesh, double tolerance) {
  std::vector<bool> keep(mesh.triangles.size());
  for (std::size_t t = 0; t < keep.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const Vector3d ab = mesh.vertices[b] - mesh.vertices[a],
                   ac = mesh.vertices[c] - mesh.vertices[a];
    const double longest = std::max({ab.norm(), ac.norm(), (ab - ac).norm()});
    keep[t] = a != b && b != c && c != a && ab.cross(ac).norm() > tolerance * longest;
  }
  keep_triangles(mesh, keep);
  return static_cast<int>(std::count(keep.begin(), keep.end(), false));
}

int drop_duplicates(TriangleMesh& mesh) {
  std::vector<std::array<int, 3>> sorted = mesh.triangles;
  for (auto& triangle : sorted) std::sort(triangle.begin(), triangle.end());
  std::vector<int> order(sorted.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](int x, int y) { return std::tie(sorted[x], x) < std::tie(sorted[y], y); });
  std::vector<bool> keep(sorted.size(), true);
  for (std::size_t i = 1; i < order.size(); ++i)
    keep[order[i]] = sorted[order[i]] != sorted[order[i - 1]];
  keep_triangles(mesh, keep);
  return static_cast<int>(std::count(keep.begin(), keep.end(), false));
}

void drop_strays(TriangleMesh& mesh, double fraction, CleaningReport& report) {
  const std::vector<int> component = find_components(mesh, mesh_edges(mesh));
  if (component.empty()) return;
  std::vector<double> area(1 + *std::max_element(component.begin(), component.end()), 0.0);
  const std::vector<Vector3d> areas = triangle_areas(mesh);
  for (std::size_t t = 0; t < areas.size(); ++t) area[component[t]] += areas[t].norm();
  std::vector<bool> keep(mesh.triangles.size());
  for (std::size_t t = 0; t < keep.size(); ++t) keep[t] = area[component[t]] >= fraction * area[0];
  report.stray_components = static_cast<int>(
      std::count_if(area.begin(), area.end(), [&](double a) { return a < fraction * area[0]; }));
  report.stray_triangles = static_cast<int>(std::count(keep.begin(), keep.end(), false));
  keep_triangles(mesh, keep);
}

}  // namespace

CleanMesh clean_mesh(TriangleMesh mesh, const CleaningOptions& options) {
  CleanMesh result;
  CleaningReport& report = result.report;
  Eigen::AlignedBox3d box;
  for (const Vector3d& p : mesh.vertices) box.extend(p);
  const double tolerance =
      mesh.vertices.empty() ? 0 : options.merge_tolerance * box.diagonal().norm();

  report.merged_vertices = merge_vertices(mesh, tolerance);
  report.degenerate_triangles = drop_degenerate(mesh, tolerance);
  report.duplicate_triangles = drop_duplicates(mesh);
  drop_strays(mesh, options.stray_fraction, report);
  report.unreferenced_vertices = drop_unreferenced_vertices(mesh);

  const std::vector<MeshEdge> edges = mesh_edges(mesh);
  result.component = find_components(mesh, edges);
  report.flipped_triangles = orient_components(mesh, edges, result.component, result.closed);
  report.components = static_cast<int>(result.closed.size());
  report.closed_components =
      static_cast<int>(std::count(result.closed.begin(), result.closed.end(), true));
  for (const MeshEdge& e : edges) {
    report.boundary_edges += e.count == 1;
    report.non_manifold_edges += e.count > 2;
  }
  result.mesh = std::move(mesh);
  return result;
}

std::vector<std::string> describe(const CleaningReport& report) {
  std::vector<std::string> lines;
  const auto say = [&lines](int count, const char* what) {
    if (count > 0) lines.push_back(fmt::format("{} {}", count, what));
  };
  say(report.degenerate_triangles, "degenerate triangles dropped");
  say(report.duplicate_triangles, "duplicate triangles dropped");
  if (report.stray_components > 0)
    lines.push_back(fmt::format("{} stray pieces ({} triangles) dropped", report.stray_components,
                                report.stray_triangles));
  say(report.flipped_triangles, "triangles turned the other way round");
  say(report.non_manifold_edges, "edges shared by more than two triangles");
  return lines;
}

}  // namespace condyle
