#include "support/patch_knee.h"

#include <cmath>
#include <functional>

#include "condyle/surface/fit_system.h"
#include "condyle/surface/patch.h"

namespace condyle::benchmarks {
namespace {

using Net = std::array<int, 2>;
using Chart = std::function<Eigen::Vector3d(double u, double v)>;

/// A patch through a chart's points over [-u, u] x [-v, v]; `outside` is
/// a point that its normals look at.
std::shared_ptr<const Surface> patch_through(
    const Chart& chart, double u, double v, const Eigen::Vector3d& outside, const Net& net) {
  const SplineGrid grid{3, net[0], net[1], -u, u, -v, v};
  constexpr int kPoints = 80;
  std::vector<DataPoint> points;
  for (int i = 0; i <= kPoints; ++i)
    for (int j = 0; j <= kPoints; ++j) {
      const double s = u * (2.0 * i / kPoints - 1), t = v * (2.0 * j / kPoints - 1);
      points.push_back({chart(s, t), {s, t}, 1});
    }
  const std::vector<CellMetric> cells(static_cast<std::size_t>(grid.cells_u() * grid.cells_v()));
  PatchData data =
      patch_data(grid, solve_fit(assemble_data(grid, points), assemble_penalty(grid, cells), 1e-3));
  const SurfacePoint middle = Patch(data).evaluate(Patch::place(0, 0));
  if (middle.n.dot(outside - middle.c) < 0) data.orientation = -1;
  return std::make_shared<Patch>(data);
}

/// The underside of an ellipsoidal condyle: u along its circumference, v along its axis x.
std::shared_ptr<const Surface> condyle_patch(const Eigen::Vector3d& center,
                                             const Eigen::Matrix3d& axes,
                                             const Eigen::Vector3d& semi_axes,
                                             const Net& net) {
  const Chart chart = [=](double u, double v) {
    const double angle = u / semi_axes.z() - 0.7, x = v / semi_axes.x();
    const double r = std::sqrt(1 - x * x);
    return Eigen::Vector3d(center + axes * Eigen::Vector3d(v, semi_axes.y() * r * std::sin(angle),
                                                           -semi_axes.z() * r * std::cos(angle)));
  };
  return patch_through(chart, 40, 0.75 * semi_axes.x(), center + Eigen::Vector3d(0, -300, -300),
                       net);
}

std::shared_ptr<const Surface> plateau_patch(const Surface& exact,
                                             const Eigen::Vector3d& middle,
                                             const Net& net) {
  const Chart chart = [&](double u, double v) {
    const Place there = exact.closest(middle + Eigen::Vector3d(v, u, 0), exact.seed(middle));
    return exact.evaluate_frame(there).c;
  };
  return patch_through(chart, 22, 16, middle + Eigen::Vector3d(0, 0, 300), net);
}

}  // namespace

Model patch_knee(const Net& net) {
  Model model = test::quadric_knee();
  model.pairs[0].on_A = plateau_patch(*model.pairs[0].on_A, {-23, -4, -24}, net);
  model.pairs[1].on_A = plateau_patch(*model.pairs[1].on_A, {23, -2, -23.5}, net);
  model.pairs[0].on_B =
      condyle_patch({-23, -2, 0}, exp_rotation({0.05, -0.03, 0.08}), {19, 26, 24}, net);
  model.pairs[1].on_B =
      condyle_patch({23, -2, 0}, exp_rotation({-0.04, 0.02, -0.06}), {18, 25, 23}, net);
  return model;
}

}  // namespace condyle::benchmarks
