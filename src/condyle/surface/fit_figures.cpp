#include "condyle/surface/fit_figures.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <vector>

#include "condyle/mesh/mesh_measures.h"
#include "condyle/surface/mesh_distance.h"
#include "condyle/surface/patch.h"

namespace condyle {
namespace {

/// Mean of squares, weighted by area.
struct MeanSquare {
  double sum = 0, area = 0;
  void add(double value, double weight) {
    sum += weight * value * value;
    area += weight;
  }
  [[nodiscard]] double root() const { return area > 0 ? std::sqrt(sum / area) : 0; }
};

double percentile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  const auto rank = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[rank];
}

/// The known part of a patch on a grid of about 1 mm.
struct Lattice {
  int nu, nv;
  double step_u, step_v;
  std::vector<bool> inside;
  std::vector<SurfacePoint> points;
  std::vector<Eigen::Vector3d> along_u, along_v;  ///< tangents
  [[nodiscard]] std::size_t at(int i, int j) const { return static_cast<std::size_t>(i) * nv + j; }
};

Lattice lay_lattice(const Patch& patch, FitFigures& figures) {
  Lattice l{};
  l.nu = std::max(2, static_cast<int>(patch.u_max() - patch.u_min()));
  l.nv = std::max(2, static_cast<int>(patch.v_max() - patch.v_min()));
  l.step_u = (patch.u_max() - patch.u_min()) / l.nu;
  l.step_v = (patch.v_max() - patch.v_min()) / l.nv;
  for (int i = 0; i < l.nu; ++i)
    for (int j = 0; j < l.nv; ++j) {
      const double u = patch.u_min() + (i + 0.5) * l.step_u,
                   v = patch.v_min() + (j + 0.5) * l.step_v;
      const double edge = patch.edge_distance(Patch::place(u, v));
      const PatchDerivatives d = patch.derivatives(u, v);
      l.inside.push_back(edge >= 0);
      l.points.push_back(patch.evaluate(Patch::place(u, v)));
      l.along_u.push_back(d.c_u);
      l.along_v.push_back(d.c_v);
      if (edge < 0) continue;
      figures.depth = std::max(figures.depth, edge);
      figures.area += d.c_u.cross(d.c_v).norm() * l.step_u * l.step_v;
    }
  return l;
}

/// Longest way and greatest turn of the normal, within runs of known points along one direction.
void measure_extent(const Lattice& l, int direction, double& extent, double& turn) {
  const int rows = direction == 0 ? l.nv : l.nu, steps = direction == 0 ? l.nu : l.nv;
  const auto& across = direction == 0 ? l.along_v : l.along_u;
  for (int row = 0; row < rows; ++row) {
    double way = 0, turned = 0;
    for (int k = 1; k < steps; ++k) {
      const std::size_t a = direction == 0 ? l.at(k - 1, row) : l.at(row, k - 1),
                        b = direction == 0 ? l.at(k, row) : l.at(row, k);
      if (!l.inside[a] || !l.inside[b]) {
        way = turned = 0;
        continue;
      }
      const SurfacePoint &p = l.points[a], &q = l.points[b];
      way += (q.c - p.c).norm();
      turned += std::atan2(p.n.cross(q.n).dot(across[a].normalized()), p.n.dot(q.n));
      extent = std::max(extent, way);
      turn = std::max(turn, std::abs(turned));
    }
  }
}

void measure_known_part(const ArticularRegion& region, const Patch& patch, FitFigures& figures) {
  const Lattice l = lay_lattice(patch, figures);
  for (int direction = 0; direction < 2; ++direction)
    measure_extent(l, direction, figures.extent[direction], figures.turn[direction]);
  const MeshDistance distance(region.mesh);
  std::vector<double> distances;
  MeanSquare all;
  for (std::size_t k = 0; k < l.points.size(); ++k) {
    if (!l.inside[k]) continue;
    distances.push_back(distance(l.points[k].c));
    all.add(distances.back(), l.along_u[k].cross(l.along_v[k]).norm());
  }
  figures.back_rms = all.root();
  figures.back_p95 = percentile(distances, 0.95);
  figures.back_max = percentile(distances, 1);
}

}  // namespace

std::array<double, 2> principal_curvatures(const SurfacePoint& at) {
  // K in a basis of the tangent plane.
  const Eigen::Vector3d a = at.n.unitOrthogonal(), b = at.n.cross(a);
  const double k_aa = a.dot(at.K * a), k_ab = a.dot(at.K * b), k_bb = b.dot(at.K * b);
  const double mean = (k_aa + k_bb) / 2, half = std::hypot((k_aa - k_bb) / 2, k_ab);
  return {mean - half, mean + half};
}

FitFigures measure_fit(const ArticularRegion& region, const PatchFit& fit, double core_margin) {
  const Patch patch(fit.patch);
  const std::vector<double> areas = vertex_areas(region.mesh);
  FitFigures figures;
  MeanSquare all, core, normals;
  std::vector<double> distances;
  bool found_core = false;
  for (std::size_t i = 0; i < areas.size(); ++i) {
    const double d = std::abs(fit.distance[i]);
    all.add(d, areas[i]);
    distances.push_back(d);
    const SurfacePoint at =
        patch.evaluate(Patch::place(fit.parameters[i].x(), fit.parameters[i].y()));
    figures.folded += at.n.dot(region.normals[i]) < 0;
    if (fit.edge_distance[i] <= core_margin) continue;
    core.add(d, areas[i]);
    normals.add(std::acos(std::clamp(at.n.dot(region.normals[i]), -1.0, 1.0)), areas[i]);
    if (d > figures.core_max || figures.core_farthest < 0) {
      figures.core_max = d;
      figures.core_farthest = static_cast<int>(i);
    }
    const auto [least, greatest] = principal_curvatures(at);
    auto& range = figures.curvature_range;
    range = found_core ? std::array{std::min(range[0], least), std::max(range[1], greatest)}
                       : std::array{least, greatest};
    found_core = true;
  }
  figures.rms = all.root();
  figures.core_rms = core.root();
  figures.core_normal_rms = normals.root();
  figures.max = percentile(distances, 1);
  figures.p95 = percentile(distances, 0.95);
  measure_known_part(region, patch, figures);
  return figures;
}

}  // namespace condyle
