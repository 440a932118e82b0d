#include "condyle/contact/surface_cover.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "condyle/contact/curvature_tensor.h"
#include "condyle/contact/neighbour_grid.h"

namespace condyle {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kLeafSize = 8;
constexpr double kBetween = 1.3;   // what lies between neighbours, beyond what they tell
constexpr double kNeighbours = 3;  // how far these are looked for, in spacings
constexpr long kSearch = 2;  // points that a search among all samples takes the time of, about,
constexpr long kLeavesOfAPoint = 2;  // and by how many it looks into
constexpr double kAtEdge = 1.5;      // nearer to an edge than this a sample stands for all up to it

}  // namespace

/// A cup of radius R rises to h = d²/2R at the distance d from its point, so 2 h/t² =
/// 1/R (1 - d²/4R²).
Rise even_rise(double radius, const Eigen::Matrix3d& K) {
  const double trace = K.trace(), greatest = largest_principal(K);
  if (trace <= 0) return {0, greatest};
  const double x = 0.5 * radius * greatest;
  if (x > 0.9) return {kInfinity, kInfinity};
  const double rise = greatest / (1 - x * x);
  return {rise - greatest, rise};
}

SurfaceCover::SurfaceCover(const Surface& surface, double spacing, std::vector<Place> samples)
    : surface_(&surface),
      spacing_(spacing),
      even_(surface.bends_evenly()),
      places_(std::move(samples)) {
  if (places_.empty()) return;
  std::vector<Eigen::Vector3d> points;
  points.reserve(places_.size());
  cells_.reserve(places_.size());
  edge_.reserve(places_.size());
  Eigen::AlignedBox3d box;
  for (const Place& place : places_) {
    cells_.push_back({surface.evaluate(place)});
    edge_.push_back(surface.edge_distance(place));
    points.push_back(cells_.back().at.c);
    box.extend(points.back());
  }
  extent_ = box.diagonal().norm();
  neighbours_ = nearest_neighbours(points, kNeighbours * spacing);
  change_.assign(cells_.size(), 0);
  for (int i = 0; i < size(); ++i) enclose(i);
  order_.resize(cells_.size());
  leaf_.resize(cells_.size());
  std::iota(order_.begin(), order_.end(), 0);
  build(0, size(), -1);
  points_.reserve(cells_.size());
  for (const int i : order_) points_.push_back(sample(i).c);
  if (!even_) lay_columns();
}

void SurfaceCover::enclose(int i) {
  SurfaceCell& cell = cells_[at(i)];
  double& change = change_[at(i)];
  for (const int other : neighbours(i)) {
    if (other < 0) break;
    const SurfacePoint& there = sample(other);
    cell.radius = std::max(cell.radius, 0.5 * (there.c - cell.at.c).norm());
    if (!even_) change = std::max(change, kBetween * tangent_change(there.K, cell.at.K, cell.at.n));
  }
  if (even_) change = even_rise(cell.radius, cell.at.K).over_quadric;
  cell.rise = 0.5 * change * cell.radius * cell.radius;
}

void SurfaceCover::lay_columns() {
  columns_.reserve(cells_.size());
  for (int i = 0; i < size(); ++i) {
    const SurfaceCell& cell = cells_[at(i)];
    const bool at_edge = edge_[at(i)] < kAtEdge * spacing_;
    columns_.add(cell.at, at_edge ? std::max(cell.radius, edge_[at(i)]) : cell.radius,
                 largest_principal(cell.at.K) + change_[at(i)]);
  }
}

/// The ball about the mean of its samples that holds their cells.
void SurfaceCover::enclose(Cluster& cluster) const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int k = cluster.first; k < cluster.last; ++k) sum += sample(in_order(k)).c;
  cluster.center = sum / (cluster.last - cluster.first);
  double square = 0, widest = 0;
  for (int k = cluster.first; k < cluster.last; ++k) {
    const SurfaceCell& cell = cells_[at(in_order(k))];
    square = std::max(square, (cell.at.c - cluster.center).squaredNorm());
    widest = std::max(widest, cell.radius);
  }
  cluster.spread = std::sqrt(square);
  cluster.radius = cluster.spread + widest;
}

int SurfaceCover::build(int first, int last, int parent) {
  const int index = static_cast<int>(clusters_.size());
  Cluster& cluster = clusters_.emplace_back();
  cluster.first = first;
  cluster.last = last;
  cluster.parent = parent;
  enclose(cluster);
  if (last - first <= kLeafSize) {
    for (int k = first; k < last; ++k) leaf_[at(in_order(k))] = index;
    return index;
  }
  Eigen::AlignedBox3d box;
  for (int k = first; k < last; ++k) box.extend(sample(in_order(k)).c);
  Eigen::Index axis;
  box.sizes().maxCoeff(&axis);
  const int half = (first + last) / 2;
  std::nth_element(order_.begin() + first, order_.begin() + half, order_.begin() + last,
                   [&](int a, int b) { return sample(a).c[axis] < sample(b).c[axis]; });
  const int low = build(first, half, index), high = build(half, last, index);
  clusters_[at(index)].child = {low, high};
  return index;
}

struct SurfaceCover::Candidate {
  int sample = -1;
  double square = kInfinity;  // of its distance [mm²]
  long leaves = 0;            // looked at
};

void SurfaceCover::find_nearest(int index, const Eigen::Vector3d& point, Candidate& nearest) const {
  const Cluster& cluster = clusters_[at(index)];
  if (cluster.child[0] < 0) {
    ++nearest.leaves;
    for (int k = cluster.first; k < cluster.last; ++k) {
      const double square = (points_[at(k)] - point).squaredNorm();
      if (square >= nearest.square) continue;
      nearest.sample = in_order(k);
      nearest.square = square;
    }
    return;
  }
  std::array<std::pair<double, int>, 2> children;
  for (const std::size_t k : {0, 1}) {
    const Cluster& child = clusters_[at(cluster.child[k])];
    children[k] = {(child.center - point).norm() - child.spread, cluster.child[k]};
  }
  if (children[1] < children[0]) std::swap(children[0], children[1]);
  for (const auto& [way, child] : children)
    if (way < 0 || way * way < nearest.square) find_nearest(child, point, nearest);
}

int SurfaceCover::nearest_within(const Eigen::Vector3d& point,
                                 double radius,
                                 long& looked_at) const {
  Candidate nearest{-1, radius * radius};
  if (!cells_.empty()) find_nearest(0, point, nearest);
  looked_at += kSearch + nearest.leaves / kLeavesOfAPoint;
  return nearest.sample;
}

int SurfaceCover::nearer(const Eigen::Vector3d& point, int one, int another) const {
  if (one < 0 || another < 0 || one == another) return std::max(one, another);
  return (sample(one).c - point).squaredNorm() < (sample(another).c - point).squaredNorm()
             ? one
             : another;
}

}  // namespace condyle
