#include "condyle/mesh/clean_mesh.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "condyle/mesh/merge_vertices.h"
#include "condyle/mesh/mesh_edges.h"
#include "condyle/mesh/mesh_measures.h"
#include "condyle/mesh/orient_mesh.h"
#include "condyle/mesh/weld_seams.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

/// Returns how many triangles go.
int keep_triangles(TriangleMesh& mesh, const std::vector<bool>& keep) {
  std::size_t kept = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (keep[t]) mesh.triangles[kept++] = mesh.triangles[t];
  const int dropped = static_cast<int>(mesh.triangles.size() - kept);
  if (dropped > 0) {
    mesh.triangles.resize(kept);
    mesh.triangles.shrink_to_fit();
  }
  return dropped;
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
  return keep_triangles(mesh, keep);
}

/// The vertices of triangles, whichever way they run, in a hash table with open addressing.
class TriangleSet {
 public:
  explicit TriangleSet(const TriangleMesh& mesh)
      : mesh_(mesh), slots_(std::bit_ceil(3 * mesh.triangles.size() / 2 + 16), -1) {}

  /// False where a triangle of the same vertices is there already.
  bool add(std::size_t t) {
    const std::array<int, 3> key = sorted(t);
    std::uint64_t hash = 0;
    for (const int v : key) {
      hash = (hash ^ static_cast<std::uint64_t>(v)) * 0x9E3779B97F4A7C15u;  // 2^64 / golden ratio
      hash ^= hash >> 29;
    }
    const std::size_t mask = slots_.size() - 1;
    std::size_t slot = hash & mask;
    for (; slots_[slot] >= 0; slot = (slot + 1) & mask)
      if (sorted(static_cast<std::size_t>(slots_[slot])) == key) return false;
    slots_[slot] = static_cast<int>(t);
    return true;
  }

 private:
  [[nodiscard]] std::array<int, 3> sorted(std::size_t t) const {
    auto [a, b, c] = mesh_.triangles[t];
    if (a > b) std::swap(a, b);
    if (b > c) std::swap(b, c);
    if (a > b) std::swap(a, b);
    return {a, b, c};
  }
  const TriangleMesh& mesh_;
  std::vector<int> slots_;
};

/// The first of its vertices stays.
int drop_duplicates(TriangleMesh& mesh) {
  std::vector<bool> keep(mesh.triangles.size());
  {
    TriangleSet known(mesh);
    for (std::size_t t = 0; t < keep.size(); ++t) keep[t] = known.add(t);
  }
  return keep_triangles(mesh, keep);
}

void drop_strays(TriangleMesh& mesh,
                 const std::vector<int>& component,
                 double fraction,
                 CleaningReport& report) {
  if (component.empty()) return;
  std::vector<double> area(1 + *std::max_element(component.begin(), component.end()), 0.0);
  for (std::size_t t = 0; t < component.size(); ++t)
    area[component[t]] += triangle_area(mesh, mesh.triangles[t]).norm();
  std::vector<bool> keep(mesh.triangles.size());
  for (std::size_t t = 0; t < keep.size(); ++t) keep[t] = area[component[t]] >= fraction * area[0];
  report.stray_components = static_cast<int>(
      std::count_if(area.begin(), area.end(), [&](double a) { return a < fraction * area[0]; }));
  report.stray_triangles = keep_triangles(mesh, keep);
}

}  // namespace

CleanMesh clean_mesh(TriangleMesh mesh, const CleaningOptions& options) {
  CleanMesh result;
  CleaningReport& report = result.report;
  report.unreferenced_vertices = drop_unreferenced_vertices(mesh);  // wherever they lie
  const double tolerance = mesh.triangles.empty()
                               ? 0
                               : options.merge_tolerance * box_of_triangles(mesh).diagonal().norm();

  report.merged_vertices = merge_vertices(mesh, tolerance);
  report.degenerate_triangles = drop_degenerate(mesh, tolerance);
  report.duplicate_triangles = drop_duplicates(mesh);
  report.seams = weld_seams(mesh);
  if (report.seams.joined > 0) {
    report.degenerate_triangles += drop_degenerate(mesh, tolerance);
    report.duplicate_triangles += drop_duplicates(mesh);
  }
  auto links = std::make_unique<TriangleLinks>(mesh);
  result.component = find_components(mesh, *links);
  drop_strays(mesh, result.component, options.stray_fraction, report);
  if (report.stray_triangles > 0) {
    links = std::make_unique<TriangleLinks>(mesh);
    result.component = find_components(mesh, *links);
  }
  report.unreferenced_vertices += drop_unreferenced_vertices(mesh);

  report.flipped_triangles = orient_components(mesh, *links, result.component, result.closed);
  report.components = static_cast<int>(result.closed.size());
  report.closed_components =
      static_cast<int>(std::count(result.closed.begin(), result.closed.end(), true));
  report.boundary_edges = links->boundary_edges();
  report.non_manifold_edges = links->non_manifold_edges();
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
  if (report.seams.length > 0) lines.push_back("warning: " + describe(report.seams));
  say(report.flipped_triangles, "triangles turned the other way round");
  say(report.non_manifold_edges, "edges shared by more than two triangles");
  return lines;
}

}  // namespace condyle
