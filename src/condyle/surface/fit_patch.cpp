#include "condyle/surface/fit_patch.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "condyle/input_error.h"
#include "condyle/mesh/mesh_measures.h"
#include "condyle/surface/fit_smoothing.h"
#include "condyle/surface/fit_system.h"
#include "condyle/surface/region_outline.h"

namespace condyle {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kMargin = 1;       // of the parameter box around the data [mm]
constexpr double kBeyondBand = 2;   // over which it falls to EdgeSmoothing::least [mm]
constexpr int kMostPoints = 16000;  // control points: a square of 25 cm, 12 s and 0.5 GB
constexpr double kGuess = 2;        // smoothing length of the first guess [mm]

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
    // Knots at multiples of the spacing, so that meshes of one knee get the same ones; round-off
    // has no say where an edge lies on a multiple.
    constexpr double kRoundOff = 1e-6;
    const auto down = [h](double x) { return h * std::floor((x - kMargin) / h + kRoundOff); };
    const auto up = [h](double x) { return h * std::ceil((x + kMargin) / h - kRoundOff); };
    grid.u_min = down(box.min().x());
    grid.u_max = up(box.max().x());
    grid.v_min = down(box.min().y());
    grid.v_max = up(box.max().y());
    grid.nu = static_cast<int>(std::lround((grid.u_max - grid.u_min) / h)) + options.degree;
    grid.nv = static_cast<int>(std::lround((grid.v_max - grid.v_min) / h)) + options.degree;
  }
  if (grid.nu > kMostPoints / std::max(grid.nv, 1))
    throw InputError(fmt::format(
        "{} x {} control points of a region of {:.0f} x {:.0f} mm, expected no more than {} "
        "in all: a smaller region, or fit.control_points",
        grid.nu, grid.nv, grid.u_max - grid.u_min, grid.v_max - grid.v_min, kMostPoints));
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

double edge_fraction(const EdgeSmoothing& edge, double inside) {
  const double change =
      inside > 0 ? (1 - edge.edge) / edge.band : (edge.edge - edge.least) / kBeyondBand;
  return std::clamp(edge.edge + change * inside, edge.least, 1.0);
}

/// The chart as flat patches whose masks tell how far the edge is: of all data, and of the
/// articular face.
struct FlatCharts {
  Patch all, face;
};

Patch flat_chart(const SplineGrid& grid,
                 const TriangleMesh& mesh,
                 const std::vector<Vector2d>& chart,
                 double small_hole) {
  std::vector<Vector3d> net;
  for (int i = 0; i < grid.nu; ++i)
    for (int j = 0; j < grid.nv; ++j)
      net.emplace_back(grid.u_min + (i - (grid.degree - 1) / 2.0) * grid.step_u(),
                       grid.v_min + (j - (grid.degree - 1) / 2.0) * grid.step_v(), 0);
  PatchData flat = patch_data(grid, std::move(net));
  TriangleMesh plane;
  plane.triangles = mesh.triangles;
  for (const Vector2d& uv : chart) plane.vertices.emplace_back(uv.x(), uv.y(), 0);
  fill_mask(flat, plane, trace_outline(mesh, small_hole), chart);
  return Patch(std::move(flat));
}

FlatCharts flat_charts(const SplineGrid& grid, const ArticularRegion& region, double small_hole) {
  Patch all = flat_chart(grid, region.mesh, region.chart, small_hole);
  std::vector<bool> keep;
  if (!region.face.empty())
    for (const auto& [a, b, c] : region.mesh.triangles)
      keep.push_back(region.face[a] && region.face[b] && region.face[c]);
  if (std::find(keep.begin(), keep.end(), true) == keep.end()) return {all, all};
  const SubMesh part = sub_mesh(region.mesh, keep);
  std::vector<Vector2d> chart;
  for (const int old : part.old_index) chart.push_back(region.chart[old]);
  return {std::move(all), flat_chart(grid, part.mesh, chart, small_hole)};
}

/// Which cells hold data, and the smoothing length there; far outside twice that of the last data.
std::vector<CellMetric> describe_cells(const SplineGrid& grid,
                                       const FlatCharts& flat,
                                       const EdgeSmoothing& edge) {
  const double outside = edge.least / kPlainEdge.least;
  std::vector<CellMetric> cells;
  for (int i = 0; i < grid.cells_u(); ++i)
    for (int j = 0; j < grid.cells_v(); ++j) {
      const Place place = Patch::place(grid.u_min + (i + 0.5) * grid.step_u(),
                                       grid.v_min + (j + 0.5) * grid.step_v());
      const double inside = flat.all.edge_distance(place);
      const double within = edge_fraction(edge, flat.face.edge_distance(place));
      cells.push_back({.smoothing = inside < -2 ? outside : within,
                       .bending = outside,
                       .known = inside > -0.5});
    }
  return cells;
}

/// Stretch of the chart on a patch at the centres of the cells.
void measure_stretch(const SplineGrid& grid, const Patch& patch, std::vector<CellMetric>& cells) {
  for (int i = 0; i < grid.cells_u(); ++i)
    for (int j = 0; j < grid.cells_v(); ++j) {
      const PatchDerivatives d = patch.derivatives(grid.u_min + (i + 0.5) * grid.step_u(),
                                                   grid.v_min + (j + 0.5) * grid.step_v());
      CellMetric& cell = cells[static_cast<std::size_t>(i) * grid.cells_v() + j];
      cell.stretch_u = std::clamp(d.c_u.norm(), 0.5, 4.0);
      cell.stretch_v = std::clamp(d.c_v.norm(), 0.5, 4.0);
    }
}

/// The smoothing length is chosen from the data of the face alone, so that crests and flanks, which
/// bend with small radii, have no say; judged away from its edge, as long as that leaves enough. For
/// normals the deeper the more, as bones touch in the middle of their faces.
double choose_on_face(const SplineGrid& grid,
                      const ArticularRegion& region,
                      const Patch& face,
                      const std::vector<DataPoint>& points,
                      std::vector<CellMetric> cells,
                      SmoothingAim aim,
                      const EdgeSmoothing& edge) {
  constexpr double kEdge = 2, kDeep = 15;  // [mm]
  std::vector<DataPoint> on_face;
  std::vector<Judgement> judged;
  std::size_t count = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!region.face.empty() && !region.face[i]) continue;
    const double inside = face.edge_distance(Patch::place(points[i].uv.x(), points[i].uv.y()));
    on_face.push_back(points[i]);
    const double depth = std::clamp(inside / kDeep, 0.0, 1.0);
    judged.push_back({.counts = inside > kEdge,
                      .weight = aim == SmoothingAim::kNormals ? depth * depth : 1,
                      .smoothing = edge_fraction(edge, inside)});
    count += inside > kEdge;
  }
  if (count < on_face.size() / 5)
    for (Judgement& judgement : judged) judgement.counts = true, judgement.weight = 1;
  const std::vector<CellMetric> within = describe_cells(grid, {face, face}, edge);
  for (std::size_t k = 0; k < cells.size(); ++k) {
    cells[k].smoothing = within[k].smoothing;
    cells[k].known = within[k].known;
  }
  return choose_smoothing(grid, on_face, judged, assemble_penalty(grid, cells), {.aim = aim})
      .length;
}

/// Closest points from the last parameters; where the way leads astray, from the nearest seed of
/// the patch.
double correct_parameters(const SplineGrid& grid,
                          const Patch& patch,
                          std::vector<DataPoint>& points) {
  double change = 0;
  for (DataPoint& point : points) {
    const Vector2d before = point.uv;
    const auto off = [&](const Vector2d& uv) {
      return (patch.derivatives(uv.x(), uv.y()).c - point.p).norm();
    };
    Vector2d after = patch.closest(point.p, Patch::place(before.x(), before.y())).numbers.head<2>();
    if (!(off(after) <= off(before)))
      after = patch.closest(point.p, patch.seed(point.p)).numbers.head<2>();
    point.uv.x() = std::clamp(after.x(), grid.u_min, grid.u_max);
    point.uv.y() = std::clamp(after.y(), grid.v_min, grid.v_max);
    change += (point.uv - before).squaredNorm();
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
    const Place place = Patch::place(point.uv.x(), point.uv.y());
    const SurfacePoint at = patch.evaluate(place);
    fit.distance.push_back(std::copysign((point.p - at.c).norm(), at.n.dot(point.p - at.c)));
    fit.edge_distance.push_back(patch.edge_distance(place));
  }
  for (double& distance : data.mask) distance -= fit.rim;
  fit.patch = std::move(data);
}

}  // namespace

PatchFit fit_patch(const ArticularRegion& region, const FitOptions& options) {
  const SplineGrid grid = make_grid(region, options);
  const double small_hole = bridged_perimeter(region.mesh);
  const RegionOutline outline = trace_outline(region.mesh, small_hole);
  std::vector<DataPoint> points = data_points(region);
  const FlatCharts flat = flat_charts(grid, region, small_hole);
  const bool plain = options.smoothing_length || options.aim == SmoothingAim::kPositions;
  const EdgeSmoothing& edge = plain ? kPlainEdge : kNormalsEdge;
  std::vector<CellMetric> cells = describe_cells(grid, flat, edge);
  DataTerm term = assemble_data(grid, points);
  // A first guess tells how the chart is stretched, so that lengths are those of the surface.
  const PenaltyTerm unstretched = assemble_penalty(grid, cells);
  measure_stretch(grid, Patch(patch_data(grid, solve_fit(term, unstretched, kGuess))), cells);
  PenaltyTerm penalty = assemble_penalty(grid, cells);

  PatchFit fit;
  fit.smoothing_length = options.smoothing_length ? *options.smoothing_length
                                                  : choose_on_face(grid, region, flat.face, points,
                                                                   cells, options.aim, edge);
  if (!options.to_the_edge) fit.rim = kUncertainRim * edge.least * fit.smoothing_length;
  PatchData data = patch_data(grid, solve_fit(term, penalty, fit.smoothing_length));

  const std::vector<double> areas = vertex_areas(region.mesh);
  for (std::size_t i = 0; i < points.size(); ++i) points[i].weight = areas[i];
  for (double change = 1e300; fit.rounds < options.rounds && change > options.settled;
       ++fit.rounds) {
    const Patch patch(data);
    change = correct_parameters(grid, patch, points);
    measure_stretch(grid, patch, cells);
    penalty = assemble_penalty(grid, cells);
    term = assemble_data(grid, points);
    data = patch_data(grid, solve_fit(term, penalty, fit.smoothing_length));
  }
  fit.condition = fit_condition(term, penalty, fit.smoothing_length);
  correct_parameters(grid, Patch(data), points);
  finish(region, outline, std::move(data), points, fit);
  if (outline.holes > 0) fit.notes.push_back(fmt::format("{} small holes bridged", outline.holes));
  fit.holes = outline.wide_holes;
  return fit;
}

}  // namespace condyle
