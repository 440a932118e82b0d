#include "condyle/verify/layer_grid.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace condyle::verification {
namespace {

constexpr double kFade = 1;        ///< border over which pressure fades at an edge [mm]
constexpr double kOpposed = -0.3;  ///< cosine between normals that face each other, at most

/// Has the one side points: has it bounds, and is it not too large for a fine grid beside one that is not (docs/results.md)?
bool has_points(const SurfaceSide& own, const SurfaceSide& other) {
  constexpr double kLong = 256;  // [mm]
  const bool is_long = own.longest_way() > kLong, other_is_long = other.longest_way() > kLong;
  return std::isfinite(own.longest_way()) && (!is_long || other_is_long);
}

/// 0 at the edge, 1 from kFade inside it.
double share_at(double edge) {
  const double x = std::clamp(edge / kFade, 0.0, 1.0);
  return x * x * x * (10 - 15 * x + 6 * x * x);
}

/// The law on cells of a grid, each divided into four so many times where it is near the other surface.
class Grid {
 public:
  Grid(const LayerPoints& side, const RigidTransform& X, const LayersInSeries& law, double weight)
      : side_(side), X_(X), law_(law), weight_(weight), cells_(side.own.cells(kFirst)) {
    for (const Cell& cell : cells_) widest_ = std::max(widest_, 2 * radius(cell, middle(cell)));
  }

  [[nodiscard]] double widest() const { return widest_; }
  /// Adds what presses; false where more than `left` closest points were asked for.
  bool add(int divisions, int& left, LayerResultant& all) {
    left_ = left;
    for (const Cell& cell : cells_) look(cell, divisions, all);
    left = left_;
    return left > 0;
  }

 private:
  static constexpr double kFirst = 4;  ///< width of cells that are not divided yet, about [mm]

  [[nodiscard]] ChartPoint middle(const Cell& cell) const {
    return side_.own.at(cell.chart, 0.5 * (cell.u0 + cell.u1), 0.5 * (cell.v0 + cell.v1));
  }
  [[nodiscard]] static double radius(const Cell& cell, const ChartPoint& at) {
    constexpr double kMore = 1.5;  // as derivatives change over a cell
    return kMore / 2 *
           std::hypot((cell.u1 - cell.u0) * at.p_u.norm(), (cell.v1 - cell.v0) * at.p_v.norm());
  }

  /// By the slope of the distance and the curvatures of both surfaces.
  [[nodiscard]] bool is_apart(const Cell& cell,
                              const ChartPoint& at,
                              const ClosestPoint& closest,
                              double r) const {
    if (closest.distance > r) return true;
    if (!(std::abs(closest.distance) * closest.curvature < 0.5)) return false;
    const Vector3d n = side_.to_other.R.transpose() * closest.n,
                   own = at.p_u.cross(at.p_v).normalized();
    const double slope = (n - n.dot(own) * own).norm();
    const double bend =
        side_.own.curvature(cell.chart, 0.5 * (cell.u0 + cell.u1), 0.5 * (cell.v0 + cell.v1)) +
        2 * closest.curvature;
    return closest.distance > slope * r + bend * r * r / 2;
  }

  void look(const Cell& cell, int divisions, LayerResultant& all) {
    if (--left_ < 0) return;
    const ChartPoint at = middle(cell);
    const Vector3d there = side_.to_other * at.p;
    const double r = radius(cell, at);
    if (side_.other.is_clear(there, r)) return;
    const ClosestPoint closest = side_.other.closest(there);
    if (is_apart(cell, at, closest, r)) return;
    if (divisions == 0) return press(cell, at, closest, all);
    const double u = 0.5 * (cell.u0 + cell.u1), v = 0.5 * (cell.v0 + cell.v1);
    for (const auto& [u0, u1] : {std::pair{cell.u0, u}, {u, cell.u1}})
      for (const auto& [v0, v1] : {std::pair{cell.v0, v}, {v, cell.v1}})
        look({cell.chart, u0, u1, v0, v1}, divisions - 1, all);
  }

  void press(const Cell& cell,
             const ChartPoint& at,
             const ClosestPoint& closest,
             LayerResultant& all) {
    const double share =
        share_at(side_.own.edge(cell.chart, 0.5 * (cell.u0 + cell.u1), 0.5 * (cell.v0 + cell.v1)));
    if (!(share > 0) || !(closest.distance < 0)) return;
    const Vector3d n = side_.to_other.R * side_.own.closest(at.p).n;
    if (n.dot(closest.n) > kOpposed) return;
    const double area = at.p_u.cross(at.p_v).norm() * (cell.u1 - cell.u0) * (cell.v1 - cell.v0);
    all.press(side_, X_, at.p, closest, weight_ * share * area * law_.pressure(-closest.distance));
  }

  const LayerPoints& side_;
  const RigidTransform& X_;
  const LayersInSeries& law_;
  double weight_;
  std::vector<Cell> cells_;
  double widest_ = 0;  ///< [mm]
  int left_ = 0;
};

}  // namespace

std::array<LayerPoints, 2> sides_of(const PairOfSides& pair, const RigidTransform& X) {
  return {LayerPoints{*pair.fixed, *pair.moving, false, X.inverse()},
          LayerPoints{*pair.moving, *pair.fixed, true, X}};
}

double share_of_a_side(const PairOfSides& pair) {
  const int sides = (has_points(*pair.fixed, *pair.moving) ? 1 : 0) +
                    (has_points(*pair.moving, *pair.fixed) ? 1 : 0);
  return 1.0 / std::max(1, sides);
}

void LayerResultant::press(const LayerPoints& side,
                           const RigidTransform& X,
                           const Vector3d& point,
                           const ClosestPoint& closest,
                           double force_here) {
  const Vector3d at = side.on_A ? X * point : point;
  const Vector3d n = side.on_A ? closest.n : Vector3d(-(X.R * closest.n));
  force += force_here * n;
  moment += force_here * (at - X.p).cross(n);
  sum += force_here;
  ++points;
  deepest = std::max(deepest, -closest.distance);
}

std::optional<LayerResultant> resultant_on_grid(const PairOfSides& pair,
                                                const RigidTransform& X,
                                                const LayersInSeries& law) {
  constexpr int kMostPlaces = 1000000;  // closest points
  constexpr int kEnough = 400;          // points that are pressed, to trust that two grids agree
  constexpr double kCoarse = 0.5,
                   kFine = 0.02;    // cells that say that nothing is pressed, and the last [mm]
  constexpr double kAgree = 0.003;  // of the force
  const std::array<LayerPoints, 2> sides = sides_of(pair, X);
  std::vector<Grid> grids;
  const double weight = share_of_a_side(pair);
  double widest = 0;
  for (const LayerPoints& side : sides)
    if (has_points(side.own, side.other)) {
      grids.emplace_back(side, X, law, weight);
      widest = std::max(widest, grids.back().widest());
    }
  std::optional<LayerResultant> before;
  int left = kMostPlaces;
  for (int divisions = 0;; ++divisions, widest /= 2) {
    LayerResultant now;
    for (Grid& grid : grids)
      if (!grid.add(divisions, left, now)) return std::nullopt;
    const double scale = std::max(now.sum, before ? before->sum : 0) + kLightForce;
    const bool agree = before && (now.force - before->force).norm() <= kAgree * scale;
    const bool enough = now.points >= kEnough || (now.points == 0 && widest <= kCoarse);
    if (widest <= kFine || (agree && enough)) return now;
    before = now;
  }
}

}  // namespace condyle::verification
