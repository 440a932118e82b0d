#include "condyle/surface/layer_fold.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

#include "condyle/surface/exact_charts.h"
#include "condyle/surface/fit_figures.h"
#include "condyle/surface/patch.h"

namespace condyle {
namespace {

class FoldSearch {
 public:
  FoldSearch(const Surface& surface, double thickness) : surface_(surface), thickness_(thickness) {}

  /// A place that stands for an area [mm²].
  void look_at(const Place& place, double area) {
    if (surface_.edge_distance(place) < 0) return;
    const SurfacePoint at = surface_.evaluate(place);
    const double convex = -principal_curvatures(at)[0];
    fold_.known += area;
    if (convex * thickness_ >= 1) fold_.area += area;
    if (!(convex > most_convex_)) return;
    most_convex_ = convex;
    fold_.where = at.c;
  }
  LayerFold found() {
    fold_.least_radius =
        most_convex_ > 0 ? 1 / most_convex_ : std::numeric_limits<double>::infinity();
    return fold_;
  }

 private:
  const Surface& surface_;
  double thickness_;
  double most_convex_ = 0;  ///< [1/mm]
  LayerFold fold_;
};

/// Calls at(u, v, cell) on a rectangle in cells of about 0.5 mm.
template <class At>
void on_cells(double u_min, double u_max, double v_min, double v_max, const At& at) {
  constexpr double kStep = 0.5;  // [mm]
  constexpr int kFewestCells = 8, kMostCells = 400;
  const auto count = [](double way) {
    return static_cast<int>(std::clamp<double>(way / kStep, kFewestCells, kMostCells));
  };
  const int nu = count(u_max - u_min), nv = count(v_max - v_min);
  const double step_u = (u_max - u_min) / nu, step_v = (v_max - v_min) / nv;
  for (int i = 0; i < nu; ++i)
    for (int j = 0; j < nv; ++j)
      at(u_min + (i + 0.5) * step_u, v_min + (j + 0.5) * step_v, step_u * step_v);
}

}  // namespace

LayerFold layer_fold(const Surface& surface, double thickness) {
  FoldSearch search(surface, thickness);
  if (const auto* patch = dynamic_cast<const Patch*>(&surface))
    on_cells(patch->u_min(), patch->u_max(), patch->v_min(), patch->v_max(),
             [&](double u, double v, double cell) {
               const PatchDerivatives d = patch->derivatives(u, v);
               search.look_at(Patch::place(u, v), d.c_u.cross(d.c_v).norm() * cell);
             });
  if (const auto* exact = dynamic_cast<const ExactSurface*>(&surface))
    for (const SurfaceChart& chart : exact->charts())
      on_cells(chart.u_min, chart.u_max, chart.v_min, chart.v_max,
               [&](double u, double v, double cell) {
                 const SurfaceChart::At at = chart.at(u, v);
                 search.look_at({at.c}, at.stretch * cell);
               });
  return search.found();
}

}  // namespace condyle
