#include "condyle/surface/offset_patch.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "condyle/input_error.h"
#include "condyle/surface/fit_figures.h"
#include "condyle/surface/fit_system.h"
#include "condyle/surface/region_outline.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

constexpr int kPerCell = 4;         // points each way in a knot cell
constexpr double kBeyond = 2;       // how far beyond the known part the offset is followed [mm]
constexpr double kSmoothing = 0.2;  // ties down control points without data only [mm]

/// The knots of a patch, each interval halved.
SplineGrid halved(const PatchData& data) {
  SplineGrid grid;
  grid.degree = data.degree[0];
  grid.u_min = data.knots_u[grid.degree], grid.u_max = data.knots_u[data.nu];
  grid.v_min = data.knots_v[grid.degree], grid.v_max = data.knots_v[data.nv];
  grid.nu = 2 * (data.nu - grid.degree) + grid.degree;
  grid.nv = 2 * (data.nv - grid.degree) + grid.degree;
  return grid;
}

/// Calls at(u, v) on a grid over all knot cells, `shift` of a step from their corners.
template <class At>
void on_grid(const SplineGrid& grid, double shift, const At& at) {
  const double step_u = grid.step_u() / kPerCell, step_v = grid.step_v() / kPerCell;
  for (int i = 0; i < kPerCell * grid.cells_u(); ++i)
    for (int j = 0; j < kPerCell * grid.cells_v(); ++j)
      at(grid.u_min + (i + shift) * step_u, grid.v_min + (j + shift) * step_v);
}

/// The sharpest hollow of the known part.
Hollow sharpest_hollow(const SplineGrid& grid, const Patch& patch) {
  Hollow sharpest;
  double greatest = 0;
  on_grid(grid, 0.5, [&](double u, double v) {
    if (patch.edge_distance(Patch::place(u, v)) < 0) return;
    const SurfacePoint at = patch.evaluate(Patch::place(u, v));
    const double curvature = principal_curvatures(at)[1];
    if (curvature > greatest) greatest = curvature, sharpest = {1 / curvature, at.c};
  });
  return sharpest;
}

void refuse_cusp(const Hollow& hollow, double offset) {
  if (offset < hollow.radius) return;
  throw InputError(
      fmt::format("offset of {:.4g} mm, expected less than the least radius of its hollows, {:.2f} "
                  "mm at ({:.1f}, "
                  "{:.1f}, {:.1f}) mm: beyond it the moved surface folds over",
                  offset, hollow.radius, hollow.at.x(), hollow.at.y(), hollow.at.z()));
}

std::vector<DataPoint> moved_points(const SplineGrid& grid, const Patch& patch, double offset) {
  std::vector<DataPoint> points;
  on_grid(grid, 0.5, [&](double u, double v) {
    const double edge = patch.edge_distance(Patch::place(u, v));
    if (edge < -kBeyond) return;
    const SurfacePoint at = patch.evaluate(Patch::place(u, v));
    // What is only extrapolated may bend more than what was checked.
    if (edge < 0 && principal_curvatures(at)[1] * offset > 0.9) return;
    points.push_back({at.c + offset * at.n, {u, v}, 1});
  });
  return points;
}

std::vector<CellMetric> cells_of(const SplineGrid& grid, const Patch& patch) {
  std::vector<CellMetric> cells;
  for (int i = 0; i < grid.cells_u(); ++i)
    for (int j = 0; j < grid.cells_v(); ++j) {
      const double u = grid.u_min + (i + 0.5) * grid.step_u(),
                   v = grid.v_min + (j + 0.5) * grid.step_v();
      cells.push_back({.known = patch.edge_distance(Patch::place(u, v)) > -kBeyond / 2});
    }
  return cells;
}

/// Distance of the moved patch from the offset surface, at points between those it was laid
/// through.
void measure(const SplineGrid& grid, const Patch& patch, double offset, OffsetPatch& result) {
  const Patch moved(result.patch);
  double square = 0, count = 0;
  on_grid(grid, 0, [&](double u, double v) {
    const Place place = Patch::place(u, v);
    if (patch.edge_distance(place) < 0) return;
    const SurfacePoint at = patch.evaluate_frame(place);
    const double d = std::abs(at.n.dot(moved.derivatives(u, v).c - at.c) - offset);
    square += d * d;
    ++count;
    result.max = std::max(result.max, d);
  });
  result.rms = std::sqrt(square / std::max(count, 1.0));
}

}  // namespace

Hollow sharpest_hollow(const Patch& patch) { return sharpest_hollow(halved(patch.data()), patch); }

OffsetPatch offset_patch(const ArticularRegion& region, const PatchFit& fit, double offset) {
  const Patch patch(fit.patch);
  const SplineGrid grid = halved(fit.patch);
  refuse_cusp(sharpest_hollow(grid, patch), offset);
  OffsetPatch result;
  result.patch =
      patch_data(grid, solve_fit(assemble_data(grid, moved_points(grid, patch, offset)),
                                 assemble_penalty(grid, cells_of(grid, patch)), kSmoothing));
  result.patch.orientation = fit.patch.orientation;

  result.region = region.mesh;
  for (std::size_t i = 0; i < result.region.vertices.size(); ++i)
    result.region.vertices[i] +=
        offset * patch.evaluate_frame(Patch::place(fit.parameters[i].x(), fit.parameters[i].y())).n;
  fill_mask(result.patch, result.region, trace_outline(region.mesh, bridged_perimeter(region.mesh)),
            fit.parameters);
  for (double& distance : result.patch.mask) distance -= fit.rim;
  measure(grid, patch, offset, result);
  return result;
}

}  // namespace condyle
