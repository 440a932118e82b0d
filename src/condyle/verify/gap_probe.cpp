#include "condyle/verify/gap_probe.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace condyle::verification {
namespace {

constexpr double kCell = 2;         ///< [mm]
constexpr double kOfDepth = 0.01;   ///< and that of an overlap: how deep is told to 1 %
constexpr std::size_t kGroup = 24;  ///< cells
constexpr double kBeside =
    1;  ///< so near to each other two points have closest points that do too [mm]
constexpr double kBent =
    2;  ///< radius of a cell that is worth six points to tell how the gap bends [mm]
constexpr double kLeaf = 0.15;         ///< [mm]
constexpr double kMoreThanSeen = 1.5;  ///< of what four corners tell

void keep(const LowestGap& found, LowestGap& best) {
  if (found.gap < best.gap) best = found;
}

}  // namespace

GapProbe::GapProbe(const SurfaceSide& sampled, const SurfaceSide& other)
    : sampled_(sampled), other_(other) {
  // A size that fits what is small or large too: 2 mm for a knee.
  const std::vector<Cell> coarse = sampled.cells(1e9);
  if (coarse.empty()) return;
  Vector3d low = Vector3d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Cell& cell : coarse)
    for (const double u : {cell.u0, cell.u1})
      for (const double v : {cell.v0, cell.v1}) {
        const Vector3d p = sampled.at(cell.chart, u, v).p;
        low = low.cwiseMin(p), high = high.cwiseMax(p);
      }
  const double extent = (high - low).norm(), size = std::clamp(kCell, extent / 200, extent / 20);
  leaf_ = kLeaf / kCell * size;
  for (const Cell& cell : sampled.cells(size)) {
    const Node made = node(cell);
    const double edge = sampled.edge(cell.chart, (cell.u0 + cell.u1) / 2, (cell.v0 + cell.v1) / 2);
    if (!(edge <= -1.5 * made.radius)) cells_.push_back(made);
  }
  if (!cells_.empty()) group(0, cells_.size());
}

GapProbe::Node GapProbe::node(const Cell& cell) const {
  const double u = (cell.u0 + cell.u1) / 2, v = (cell.v0 + cell.v1) / 2;
  Node node{cell, sampled_.at(cell.chart, u, v).p, 0, sampled_.curvature(cell.chart, u, v)};
  for (const double a : {cell.u0, u, cell.u1})
    for (const double b : {cell.v0, v, cell.v1}) {
      node.radius = std::max(node.radius, (sampled_.at(cell.chart, a, b).p - node.middle).norm());
      node.curvature = std::max(node.curvature, sampled_.curvature(cell.chart, a, b));
    }
  node.radius *= 1.1;  // a way on the surface is longer than the chord
  return node;
}

GapProbe::Reading GapProbe::read(
    const RigidTransform& X, int chart, double u, double v, const ClosestPoint* near) const {
  const ChartPoint at = sampled_.at(chart, u, v);
  const Vector3d p = X * at.p;
  const ClosestPoint closest = near != nullptr ? other_.closest_near(p, *near) : other_.closest(p);
  const Vector3d n = X.R.transpose() * closest.n, normal = at.p_u.cross(at.p_v).normalized();
  const bool known = closest.edge >= 0 && sampled_.edge(chart, u, v) >= 0;
  const bool behind =
      closest.distance < -other_.solid_depth() && n.dot(sampled_.closest(at.p).n) > 0;
  const double slope = (n - n.dot(normal) * normal).norm();
  return {closest.distance,
          known && !behind,
          known && behind,
          at.p,
          {n.dot(at.p_u), n.dot(at.p_v)},
          slope,
          closest};
}

/// By differences of gradients over kStep [1/mm].
Eigen::Matrix2d GapProbe::hessian(
    const RigidTransform& X, int chart, double u, double v, const Reading& at) const {
  constexpr double kStep = 1e-4;  // [mm]
  const Eigen::Vector2d scale = scales(chart, u, v), g = at.gradient.cwiseProduct(scale);
  Eigen::Matrix2d H;
  for (int i = 0; i < 2; ++i) {
    const Eigen::Vector2d step = kStep * scale.cwiseProduct(Eigen::Vector2d::Unit(i));
    const Reading beside = read(X, chart, u + step.x(), v + step.y(), &at.closest);
    H.col(i) = (beside.gradient.cwiseProduct(scale) - g) / kStep;
  }
  return (H + H.transpose()) / 2;
}

/// Parameter per mm along u and along v.
Eigen::Vector2d GapProbe::scales(int chart, double u, double v) const {
  const ChartPoint at = sampled_.at(chart, u, v);
  return {1 / at.p_u.norm(), 1 / at.p_v.norm()};
}

LowestGap GapProbe::refine(
    const RigidTransform& X, int chart, double u, double v, const ClosestPoint* near) const {
  Reading now = read(X, chart, u, v, near);
  LowestGap lowest;
  if (!now.known) return lowest;
  const Eigen::Vector2d scale = scales(chart, u, v);
  for (int i = 0; i < 25; ++i) {
    constexpr double kLongest = 0.5;  // [mm]
    const Eigen::Vector2d g = now.gradient.cwiseProduct(scale);
    const Eigen::Matrix2d H = hessian(X, chart, u, v, now);
    Eigen::Vector2d step = -g / std::max(g.norm(), 1e-300) * std::min(kLongest, leaf_);
    if (H.determinant() > 1e-12 && H.trace() > 0) step = -H.inverse() * g;
    if (step.norm() > kLongest) step *= kLongest / step.norm();
    bool moved = false;
    for (int half = 0; half < 12 && !moved; ++half, step /= 2) {
      const Eigen::Vector2d to = Eigen::Vector2d(u, v) + step.cwiseProduct(scale);
      const Reading next = read(X, chart, to.x(), to.y(), &now.closest);
      if (!next.known || !(next.gap < now.gap)) continue;
      moved = true;
      u = to.x(), v = to.y(), now = next;
      if (step.norm() < 1e-9) i = 25;
    }
    if (!moved) break;
  }
  return {now.gap, now.point};
}

/// By the quadratic of the gap at the cell's middle, each principal direction at its worst, less 1.5 times what
/// the gradient at the corners departs from it on the way, along either parameter (an estimate, as that of the curvatures is):
/// surfaces that nearly conform are told apart by that alone, as the curvatures of either say nothing of their difference.
double GapProbe::bound_by_bending(const Node& node, const Reading& at, Search& search) const {
  search.left -= 6;
  const Cell& c = node.cell;
  const double u = (c.u0 + c.u1) / 2, v = (c.v0 + c.v1) / 2;
  const Eigen::Vector2d scale = scales(c.chart, u, v), g = at.gradient.cwiseProduct(scale);
  const Eigen::Matrix2d H = hessian(search.X, c.chart, u, v, at);
  double departs = 0, r = 0;
  for (const double a : {c.u0, c.u1})
    for (const double b : {c.v0, c.v1}) {
      const Eigen::Vector2d way = Eigen::Vector2d(a - u, b - v).cwiseQuotient(scale);
      const Reading corner = read(search.X, c.chart, a, b, &at.closest);
      const Eigen::Vector2d off = corner.gradient.cwiseProduct(scale) - g - H * way;
      departs = std::max(departs, off.cwiseProduct(way).lpNorm<1>());
      r = std::max(r, way.norm());
    }
  if (!H.allFinite() || !std::isfinite(departs)) return -std::numeric_limits<double>::infinity();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> principal;
  principal.computeDirect(H);
  double bound = at.gap - kMoreThanSeen * departs;
  for (int i = 0; i < 2; ++i) {
    const double slope = std::abs(principal.eigenvectors().col(i).dot(g)),
                 bend = principal.eigenvalues()[i];
    bound -= bend * r > slope ? slope * slope / (2 * bend) : slope * r - bend * r * r / 2;
  }
  return bound;
}

/// The middle of a leaf, or a corner where that is not known.
void GapProbe::look_closely(const Node& node, const ClosestPoint* near, Search& search) const {
  constexpr int kRefinement = 30;  // closest points, about
  search.left -= kRefinement;
  const Cell& c = node.cell;
  const double u = (c.u0 + c.u1) / 2, v = (c.v0 + c.v1) / 2;
  LowestGap found = refine(search.X, c.chart, u, v, near);
  if (std::isinf(found.gap))
    for (const double a : {c.u0, c.u1})
      for (const double b : {c.v0, c.v1}) keep(refine(search.X, c.chart, a, b, near), found);
  keep(found, search.best);
}

void GapProbe::look(const Node& node, const ClosestPoint* near, Search& search) const {
  if (--search.left < 0) return;
  if (near == nullptr && other_.is_clear(search.X * node.middle, node.radius)) return;
  const Cell& c = node.cell;
  look_into(node, read(search.X, c.chart, (c.u0 + c.u1) / 2, (c.v0 + c.v1) / 2, near), search);
}

/// Over a cell of radius r the gap is no lower than φ - r, nor than φ - s r - k r²/2 with its slope
/// s and the curvatures of both surfaces.
void GapProbe::look_into(const Node& node, const Reading& at, Search& search) const {
  const double found = std::min(search.best.gap, search.wanted), r = node.radius;
  const double wanted = found - std::max(kNoise, -kOfDepth * found);
  if (at.known) keep({at.gap, at.point}, search.best);
  // Below what is not known of the other side nothing is said.
  if (at.gap < 0 && at.closest.edge < -3 * r) return;
  search.behind |= at.behind;
  if (at.behind && at.gap + r < -other_.solid_depth()) return;
  double bound = at.gap - r;
  if (std::abs(at.gap) * at.closest.curvature < 0.5)
    bound = std::max(
        bound, at.gap - at.slope * r - (node.curvature + 2 * at.closest.curvature) * r * r / 2);
  if (bound > wanted) return;
  if (r < kBent && bound_by_bending(node, at, search) > wanted) return;
  if (!(r > leaf_)) return look_closely(node, &at.closest, search);
  divide(node, at, search);
}

/// Into four, or along its longer side into two.
void GapProbe::divide(const Node& node, const Reading& at, Search& search) const {
  constexpr double kLong = 2, kMore = 1.1;  // a way on the surface is longer than the chord
  const Cell& c = node.cell;
  const Eigen::Vector2d sides =
      Eigen::Vector2d(c.u1 - c.u0, c.v1 - c.v0)
          .cwiseQuotient(scales(c.chart, (c.u0 + c.u1) / 2, (c.v0 + c.v1) / 2));
  const int nu = sides.y() > kLong * sides.x() ? 1 : 2, nv = sides.x() > kLong * sides.y() ? 1 : 2;
  const double du = (c.u1 - c.u0) / nu, dv = (c.v1 - c.v0) / nv, r = node.radius;
  const double part_of_r = kMore * std::hypot(sides.x() / nu, sides.y() / nv) / sides.norm();
  for (int i = 0; i < nu; ++i)
    for (int j = 0; j < nv; ++j) {
      const double a = c.u0 + i * du, b = c.v0 + j * dv, u = a + du / 2, v = b + dv / 2;
      if (sampled_.edge(c.chart, u, v) < -1.5 * r) continue;
      const Node part{{c.chart, a, a + du, b, b + dv},
                      sampled_.at(c.chart, u, v).p,
                      part_of_r * r,
                      node.curvature};
      look(part, r < kBeside ? &at.closest : nullptr, search);
    }
}

/// Cells in groups of neighbours, each within a ball.
void GapProbe::group(std::size_t begin, std::size_t end) {
  Vector3d low = cells_[begin].middle, high = low;
  for (std::size_t i = begin; i < end; ++i)
    low = low.cwiseMin(cells_[i].middle), high = high.cwiseMax(cells_[i].middle);
  int axis = 0;
  (high - low).maxCoeff(&axis);
  if (end - begin > kGroup) {
    const std::size_t middle = (begin + end) / 2;
    const auto at = [&](std::size_t i) { return cells_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(begin), at(middle), at(end), [axis](const Node& a, const Node& b) {
      return a.middle[axis] < b.middle[axis];
    });
    group(begin, middle);
    group(middle, end);
    return;
  }
  Group made{(low + high) / 2, 0, begin, end};
  for (std::size_t i = begin; i < end; ++i)
    made.radius = std::max(made.radius, (cells_[i].middle - made.middle).norm() + cells_[i].radius);
  groups_.push_back(made);
}

LowestGap GapProbe::lowest(const RigidTransform& X, double wanted) const {
  struct Seen {
    const Node* node;
    Reading at;
  };
  std::vector<Seen> seen;
  for (const Group& group : groups_) {
    if (other_.is_clear(X * group.middle, group.radius)) continue;
    for (std::size_t i = group.begin; i < group.end; ++i) {
      const Node& node = cells_[i];
      const Cell& c = node.cell;
      if (other_.is_clear(X * node.middle, node.radius)) continue;
      seen.push_back({&node, read(X, c.chart, (c.u0 + c.u1) / 2, (c.v0 + c.v1) / 2)});
      if (!std::isfinite(seen.back().at.gap) || !std::isfinite(node.radius))
        return {std::numeric_limits<double>::quiet_NaN(), node.middle};
    }
  }
  // First where it is lowest by the middles of the cells: all bounds are then the sharper.
  std::sort(seen.begin(), seen.end(),
            [](const Seen& a, const Seen& b) { return a.at.gap < b.at.gap; });
  Search search{X, wanted};
  for (const Seen& one : seen) {
    if (!one.at.known) continue;
    look_closely(*one.node, &one.at.closest, search);
    break;
  }
  for (const Seen& one : seen) look_into(*one.node, one.at, search);
  search.best.behind = search.behind;
  search.best.exact = search.left >= 0 || search.best.gap < wanted - kNoise;
  return search.best;
}

}  // namespace condyle::verification
