#include "surface/fit_figures.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <vector>

#include "mesh/mesh_measures.h"
#include "surface/patch.h"

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
    if (fit.edge_distance[i] <= core_margin) continue;
    const SurfacePoint at = patch.evaluate({fit.parameters[i].x(), fit.parameters[i].y(), 0});
    core.add(d, areas[i]);
    normals.add(std::acos(std::clamp(at.n.dot(region.normals[i]), -1.0, 1.0)), areas[i]);
    figures.core_max = std::max(figures.core_max, d);
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
  return figures;
}

}  // namespace condyle
