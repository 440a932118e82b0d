#include "surface/fit_patch.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "input_error.h"
#include "mesh/mesh_measures.h"
#include "surface/fit_smoothing.h"
#include "surface/fit_system.h"
#include "surface/region_outline.h"

namespace condyle {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kMargin = 1;  // of the parameter box around the data [mm]
constexpr double kEdgeSmoothing = 0.7,
                 kEdgeBand = 8;  // smoothing length at the edge as a fraction; over [mm]

SplineGrid make_grid(const ArticularRegion& region, const FitOptions& options) {
  Eigen::AlignedBox2d box;
  for (const Vector2d& uv : region.chart) box.extend(uv);
  SplineGrid grid;
  grid.degree = options.degree;
  const double h = options.knot_spacing;
  if (options.control_points) {
    grid.u_min = box.min().x() - kMargin;
    grid.u_max = box.max().x() + kMargin;
    grid.v_min = box.min().y() - kMargin;
    grid.v_max = box.max().y() + kMargin;
    grid.nu = (*options.control_points)[0], grid.nv = (*options.control_points)[1];
  } else {
    // Knots at multiples of the spacing, so that meshes of one knee get the same ones.
    const auto down = [h](double x) { return h * std::floor((x - kMargin) / h); };
    const auto up = [h](double x) { return h * std::ceil((x + kMargin) / h); };
    grid.u_min = down(box.min().x());
    grid.u_max = up(box.max().x());
    grid.v_min = down(box.min().y());
    grid.v_max = up(box.max().y());
    grid.nu = static_cast<int>(std::lround((grid.u_max - grid.u_min) / h)) + options.degree;
    grid.nv = static_cast<int>(std::lround((grid.v_max - grid.v_min) / h)) + options.degree;
  }
  const int least = options.degree + 1, vertices = static_cast<int>(region.mesh.vertices.size());
  if (grid.nu < least || grid.nv < least)
    throw InputError(fmt::format("{} x {} control points, expected at least {} each way", grid.nu,
                                 grid.nv, least));
  if (vertices < 30 || (options.control_points && vertices < grid.size()))
    throw InputError(fmt::format("the region holds {} vertices, too few for {} x {} control points",
                                 vertices, grid.nu, grid.nv));
  return grid;
}

/// Area of each vertex; in the first fit, where distances run along the chart direction, slopes
/// count less.
std::vector<DataPoint> data_points(const ArticularRegion& region) {
  const std::vector<double> areas = vertex_areas(region.mesh);
  std::vector<DataPoint> points;
  points.reserve(areas.size());
  for (std::size_t i = 0; i < areas.size(); ++i) {
    const double slope = std::max(region.slope[i], 0.1);
    points.push_back({region.mesh.vertices[i], region.chart[i], areas[i] * slope * slope});
  }
  return points;
}

/// Less smoothing near the edge, where bones are round with small radii.
double edge_fraction(double inside) {
  return std::clamp(kEdgeSmoothing + (1 - kEdgeSmoothing) * inside / kEdgeBand, kEdgeSmoothing,
                    1.0);
}

/// Stretch of the chart on a patch at the centres of the cells; which cells hold data, from its
/// mask.
std::vector<CellMetric> measure_cells(const SplineGrid& grid, const Patch& patch) {
  std::vector<CellMetric> cells;
  for (int i = 0; i < grid.cells_u(); ++i)
    for (int j = 0; j < grid.cells_v(); ++j) {
      const double u = grid.u_min + (i + 0.5) * grid.step_u(),
                   v = grid.v_min + (j + 0.5) * grid.step_v();
      const PatchDerivatives d = patch.derivatives(u, v);
      const double inside = patch.edge_distance({u, v, 0});
      cells.push_back({.stretch_u = std::clamp(d.c_u.norm(), 0.5, 4.0),
                       .stretch_v = std::clamp(d.c_v.norm(), 0.5, 4.0),
                       .smoothing = inside < -2 ? 1 : edge_fraction(inside),
                       .known = inside > -0.5});
    }
  return cells;
}

/// The chart itself as a flat patch, with its mask.
Patch flat_patch(const SplineGrid& grid,
                 const ArticularRegion& region,
                 const RegionOutline& outline) {
  std::vector<Vector3d> net;
  for (int i = 0; i < grid.nu; ++i)
    for (int j = 0; j < grid.nv; ++j)
      net.emplace_back(grid.u_min + (i - (grid.degree - 1) / 2.0) * grid.step_u(),
                       grid.v_min + (j - (grid.degree - 1) / 2.0) * grid.step_v(), 0);
  PatchData flat = patch_data(grid, std::move(net));
  TriangleMesh plane;
  plane.triangles = region.mesh.triangles;
  for (const Vector2d& uv : region.chart) plane.vertices.emplace_back(uv.x(), uv.y(), 0);
  fill_mask(flat, plane, outline, region.chart);
  return Patch(std::move(flat));
}

/// The smoothing length is judged away from the edge, where side walls and rims begin, as long as
/// that leaves enough.
std::vector<Judgement> judged_points(const Patch& flat, const std::vector<DataPoint>& points) {
  constexpr double kEdge = 2;  // [mm]
  std::vector<Judgement> judged;
  std::size_t count = 0;
  for (const DataPoint& p : points) {
    const double inside = flat.edge_distance({p.uv.x(), p.uv.y(), 0});
    judged.push_back({.counts = inside > kEdge, .smoothing = edge_fraction(inside)});
    count += inside > kEdge;
  }
  if (count < points.size() / 5)
    for (Judgement& judgement : judged) judgement.counts = true;
  return judged;
}

/// Closest points from the last parameters; where the way leads astray, from the nearest seed of
/// the patch.
double correct_parameters(const SplineGrid& grid,
                          const Patch& patch,
                          std::vector<DataPoint>& points) {
  double change = 0;
  for (DataPoint& point : points) {
    const Place before(point.uv.x(), point.uv.y(), 0);
    Place after = patch.closest(point.p, before);
    const double far = (patch.derivatives(before.x(), before.y()).c - point.p).norm();
    if (!((patch.derivatives(after.x(), after.y()).c - point.p).norm() <= far))
      after = patch.closest(point.p, patch.seed(point.p));
    point.uv.x() = std::clamp(after.x(), grid.u_min, grid.u_max);
    point.uv.y() = std::clamp(after.y(), grid.v_min, grid.v_max);
    change += (point.uv - Vector2d(before.x(), before.y())).squaredNorm();
  }
  return std::sqrt(change / static_cast<double>(points.size()));
}

int find_orientation(const ArticularRegion& region,
                     const Patch& patch,
                     const std::vector<DataPoint>& points) {
  double sum = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const PatchDerivatives d = patch.derivatives(points[i].uv.x(), points[i].uv.y());
    sum += d.c_u.cross(d.c_v).dot(region.normals[i]);
  }
  return sum < 0 ? -1 : 1;
}

void finish(const ArticularRegion& region,
            const RegionOutline& outline,
            PatchData data,
            std::vector<DataPoint>& points,
            PatchFit& fit) {
  for (const DataPoint& point : points) fit.parameters.push_back(point.uv);
  fill_mask(data, region.mesh, outline, fit.parameters);
  data.orientation = find_orientation(region, Patch(data), points);
  const Patch patch(data);
  for (const DataPoint& point : points) {
    const Place place(point.uv.x(), point.uv.y(), 0);
    const SurfacePoint at = patch.evaluate(place);
    fit.distance.push_back(std::copysign((point.p - at.c).norm(), at.n.dot(point.p - at.c)));
    fit.edge_distance.push_back(patch.edge_distance(place));
  }
  for (double& distance : data.mask) distance -= kUncertainRim * fit.smoothing_length;
  fit.patch = std::move(data);
}

}  // namespace

PatchFit fit_patch(const ArticularRegion& region, const FitOptions& options) {
  const SplineGrid grid = make_grid(region, options);
  const double edge = mean_edge_length(region.mesh);
  const RegionOutline outline = trace_outline(region.mesh, std::max(12.0, 8 * edge));
  std::vector<DataPoint> points = data_points(region);
  const Patch flat = flat_patch(grid, region, outline);
  std::vector<CellMetric> cells = measure_cells(grid, flat);
  PenaltyTerm penalty = assemble_penalty(grid, cells);

  PatchFit fit;
  fit.smoothing_length =
      options.smoothing_length
          ? *options.smoothing_length
          : choose_smoothing(grid, points, judged_points(flat, points), penalty).length;
  DataTerm term = assemble_data(grid, points);
  PatchData data = patch_data(grid, solve_fit(term, penalty, fit.smoothing_length));

  const std::vector<double> areas = vertex_areas(region.mesh);
  for (std::size_t i = 0; i < points.size(); ++i) points[i].weight = areas[i];
  for (double change = 1e300; fit.rounds < options.rounds && change > options.settled;
       ++fit.rounds) {
    const Patch patch(data);
    change = correct_parameters(grid, patch, points);
    const std::vector<CellMetric> stretched = measure_cells(grid, patch);
    for (std::size_t k = 0; k < cells.size(); ++k) {
      cells[k].stretch_u = stretched[k].stretch_u;
      cells[k].stretch_v = stretched[k].stretch_v;
    }
    penalty = assemble_penalty(grid, cells);
    term = assemble_data(grid, points);
    data = patch_data(grid, solve_fit(term, penalty, fit.smoothing_length));
  }
  fit.condition = fit_condition(term, penalty, fit.smoothing_length);
  correct_parameters(grid, Patch(data), points);
  finish(region, outline, std::move(data), points, fit);
  if (outline.holes > 0) fit.notes.push_back(fmt::format("{} small holes bridged", outline.holes));
  if (outline.wide_holes > 0)
    fit.notes.push_back(fmt::format("{} wide holes left out", outline.wide_holes));
  return fit;
}

}  // namespace condyle
