#include "condyle/surface/region_outline.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <unordered_map>
#include <utility>

#include "condyle/mesh/mesh_measures.h"

namespace condyle {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kMaskStep = 1;  // [mm of parameter]

/// Chains of boundary vertices. Where two touch at a vertex each is one of its own, wherever the walk along them
/// began: what comes back to a vertex is a loop. Those with ends, as where more than two triangles share an edge or
/// triangles face each other, come first, and whole.
std::vector<std::vector<int>> boundary_chains(const TriangleMesh& region) {
  std::multimap<int, int> next;
  std::map<int, int> ends;  // edges that lead away from a vertex, less those that lead to it
  for (const MeshEdge& e : mesh_edges(region)) {
    if (e.count != 1) continue;
    const int from = e.forward[0] ? e.a : e.b, to = e.forward[0] ? e.b : e.a;
    next.emplace(from, to);
    ++ends[from];
    --ends[to];
  }
  std::vector<int> begins;
  for (const auto& [vertex, more] : ends) begins.insert(begins.end(), std::max(more, 0), vertex);
  std::vector<std::vector<int>> loops;
  while (!next.empty()) {
    std::vector<int> walk = {begins.empty() ? next.begin()->first : begins.back()};
    if (!begins.empty()) begins.pop_back();
    std::unordered_map<int, std::size_t> place = {
        {walk.front(), 0}};  // in the walk, of each vertex
    for (auto step = next.find(walk.front()); step != next.end(); step = next.find(walk.back())) {
      const int to = step->second;
      next.erase(step);
      const auto [met, fresh] = place.try_emplace(to, walk.size());
      walk.push_back(to);
      if (fresh) continue;
      const auto begin = walk.begin() + static_cast<std::ptrdiff_t>(met->second);
      loops.emplace_back(begin, walk.end());
      for (auto vertex = begin + 1; vertex + 1 < walk.end(); ++vertex) place.erase(*vertex);
      walk.erase(begin + 1, walk.end());
    }
    if (walk.size() > 1) loops.push_back(std::move(walk));
  }
  return loops;
}

double perimeter(const TriangleMesh& region, const std::vector<int>& loop) {
  double sum = 0;
  for (std::size_t i = 1; i < loop.size(); ++i)
    sum += (region.vertices[loop[i]] - region.vertices[loop[i - 1]]).norm();
  return sum;
}

void add_hole(const TriangleMesh& region,
              const std::vector<int>& loop,
              double perimeter,
              WideHoles& holes) {
  ++holes.count;
  if (perimeter <= holes.perimeter) return;
  holes.perimeter = perimeter;
  holes.middle.setZero();
  for (std::size_t i = 1; i < loop.size(); ++i) holes.middle += region.vertices[loop[i]];
  holes.middle /= static_cast<double>(loop.size() - 1);
}

double square_distance(const Vector3d& p, const Vector3d& a, const Vector3d& b) {
  const Vector3d ab = b - a, ap = p - a;
  const double t = std::clamp(ap.dot(ab) / std::max(ab.squaredNorm(), 1e-300), 0.0, 1.0);
  return (ap - t * ab).squaredNorm();
}

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Marks the grid corners that a triangle of the parameter plane covers.
struct CornerGrid {
  double u0, v0, step_u, step_v;
  int nu, nv;  ///< corners
  std::vector<char> inside;

  void cover(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
    const double area = cross(b - a, c - a);
    if (std::abs(area) < 1e-14) return;
    const auto range = [](double low, double high, double origin, double step, int n) {
      return std::array<int, 2>{
          std::max(0, static_cast<int>(std::ceil((low - origin) / step))),
          std::min(n - 1, static_cast<int>(std::floor((high - origin) / step)))};
    };
    const auto [i0, i1] =
        range(std::min({a.x(), b.x(), c.x()}), std::max({a.x(), b.x(), c.x()}), u0, step_u, nu);
    const auto [j0, j1] =
        range(std::min({a.y(), b.y(), c.y()}), std::max({a.y(), b.y(), c.y()}), v0, step_v, nv);
    for (int i = i0; i <= i1; ++i)
      for (int j = j0; j <= j1; ++j) {
        const Vector2d p(u0 + i * step_u, v0 + j * step_v);
        const double x = cross(b - p, c - p) / area, y = cross(c - p, a - p) / area,
                     z = cross(a - p, b - p) / area;
        if (std::min({x, y, z}) >= -1e-12) inside[static_cast<std::size_t>(i) * nv + j] = 1;
      }
  }
};

}  // namespace

double bridged_perimeter(const TriangleMesh& region) {
  return std::max(12.0, 8 * mean_edge_length(region));
}

RegionOutline trace_outline(const TriangleMesh& region, double small_hole) {
  const std::vector<std::vector<int>> chains = boundary_chains(region);
  const auto closed = [](const std::vector<int>& chain) { return chain.front() == chain.back(); };
  double longest = 0, with_ends = 0;
  for (const std::vector<int>& chain : chains) {
    const double length = perimeter(region, chain);
    (closed(chain) ? longest : with_ends) =
        closed(chain) ? std::max(longest, length) : with_ends + length;
  }
  const double rim = std::max(longest, with_ends);
  RegionOutline outline;
  for (const std::vector<int>& chain : chains) {
    const double length = perimeter(region, chain);
    const bool hole = closed(chain) && length < rim;
    if (hole && length < small_hole) {
      for (std::size_t i = 2; i + 1 < chain.size(); ++i)
        outline.hole_fans.push_back({chain[0], chain[i], chain[i - 1]});
      ++outline.holes;
      continue;
    }
    for (std::size_t i = 1; i < chain.size(); ++i)
      outline.edges.push_back({chain[i - 1], chain[i]});
    if (hole) add_hole(region, chain, length, outline.wide_holes);
  }
  return outline;
}

void fill_mask(PatchData& data,
               const TriangleMesh& region,
               const RegionOutline& outline,
               const std::vector<Vector2d>& uv) {
  const double u0 = data.knots_u[data.degree[0]], u1 = data.knots_u[data.nu];
  const double v0 = data.knots_v[data.degree[1]], v1 = data.knots_v[data.nv];
  data.mask.clear();
  const Patch patch(data);
  const int nu = std::max(2, static_cast<int>(std::lround((u1 - u0) / kMaskStep)));
  const int nv = std::max(2, static_cast<int>(std::lround((v1 - v0) / kMaskStep)));
  CornerGrid grid{u0, v0, (u1 - u0) / nu, (v1 - v0) / nv, nu + 1, nv + 1, {}};
  grid.inside.assign(static_cast<std::size_t>(nu + 1) * (nv + 1), 0);
  for (const auto& [a, b, c] : region.triangles) grid.cover(uv[a], uv[b], uv[c]);
  for (const auto& [a, b, c] : outline.hole_fans) grid.cover(uv[a], uv[b], uv[c]);

  data.mask_nu = nu;
  data.mask_nv = nv;
  data.mask.resize(grid.inside.size());
  for (int i = 0; i <= nu; ++i)
    for (int j = 0; j <= nv; ++j) {
      const Vector3d p = patch.derivatives(u0 + i * grid.step_u, v0 + j * grid.step_v).c;
      double square = std::numeric_limits<double>::max();
      for (const auto& [a, b] : outline.edges)
        square = std::min(square, square_distance(p, region.vertices[a], region.vertices[b]));
      const std::size_t k = static_cast<std::size_t>(i) * (nv + 1) + j;
      data.mask[k] = (grid.inside[k] ? 1 : -1) * std::sqrt(square);
    }
}

}  // namespace condyle
