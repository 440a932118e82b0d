#include "condyle/contact/surface_cover.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "condyle/contact/curvature_tensor.h"
#include "condyle/surface/point_tree.h"

namespace condyle {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kLeafSize = 8;
constexpr double kBetween = 1.3;   // what lies between neighbours, beyond what they tell
constexpr double kNeighbours = 3;  // how far these are looked for, in spacings
constexpr double kLost = 2.5;      // beside a sample farther than this, in spacings: beyond
constexpr double kFine = 0.36;     // of a piece: what a quadric is fitted to
constexpr double kWithin = 0.7;    // of the radius of a cell: well within
constexpr double kAtEdge = 1.5;    // nearer to an edge than this a sample stands for all up to it
constexpr double kSmall = 0.125;   // a cluster counts as one cell below this share of its way

/// For each point the up to eight nearest others within `radius` [mm]; -1 fills up.
std::vector<std::array<int, 8>> nearest_neighbours(const std::vector<Eigen::Vector3d>& points,
                                                   const PointTree& tree,
                                                   double radius) {
  std::vector<std::array<int, 8>> neighbours(points.size());
  std::array<unsigned int, 9> index;
  std::array<double, 9> square;
  for (std::size_t i = 0; i < points.size(); ++i) {
    neighbours[i].fill(-1);
    const std::size_t found = tree.knnSearch(points[i].data(), 9, index.data(), square.data());
    std::size_t k = 0;
    for (std::size_t j = 0; j < found && k < 8; ++j)
      if (index[j] != static_cast<unsigned int>(i) && square[j] < radius * radius)
        neighbours[i][k++] = static_cast<int>(index[j]);
  }
  return neighbours;
}

/// Of a cell as seen from a point of the surface; within the cell the curvature changes by
/// `change_within`.
Rise rise_of(const SurfaceCell& cell, double change_within, const SurfacePoint& from) {
  const SurfacePoint& to = cell.at;
  const double radius = cell.radius;
  const Eigen::Vector3d d = to.c - from.c;
  const double height = from.n.dot(d);
  const Eigen::Vector3d t = d - height * from.n;
  const double square = t.squaredNorm();
  if (from.n.dot(to.n) < 0.5) return {kInfinity, 2 * height / std::max(square, radius * radius)};
  const double change = tangent_change(to.K, from.K, from.n);
  if (square < 4 * radius * radius) {
    const double rise = change + change_within;
    return {rise, largest_principal(from.K) + rise};
  }
  const double quadric = t.dot(from.K * t), over = 2 * height - quadric;
  const double part = radius * radius / square;
  const double rise =
      (over + 2 * cell.rise) / square + (change + 3 * std::abs(over) / square) * part;
  const double turn = 2 * from.K.norm() * part;  // of the direction within the cell
  return {rise, quadric / square + rise + turn};
}

}  // namespace

/// With its points, so that it stays where a cover moves.
struct SurfaceCover::Tree {
  explicit Tree(std::vector<Eigen::Vector3d> of)
      : points(std::move(of)), cloud{points}, search(3, cloud) {}
  std::vector<Eigen::Vector3d> points;
  PointCloud cloud;
  PointTree search;
};

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

SurfaceCover::SurfaceCover(const Surface& surface, double spacing)
    : surface_(&surface),
      spacing_(spacing),
      even_(surface.bends_evenly()),
      places_(surface.samples(spacing)) {
  if (places_.empty()) return;
  std::vector<Eigen::Vector3d> points;
  Eigen::AlignedBox3d box;
  for (const Place& place : places_) {
    cells_.push_back({surface.evaluate(place)});
    edge_.push_back(surface.edge_distance(place));
    points.push_back(cells_.back().at.c);
    box.extend(points.back());
  }
  extent_ = box.diagonal().norm();
  tree_ = std::make_shared<const Tree>(std::move(points));
  neighbours_ = nearest_neighbours(tree_->points, tree_->search, kNeighbours * spacing);
  change_.assign(cells_.size(), 0);
  for (int i = 0; i < size(); ++i) enclose(i);
  order_.resize(cells_.size());
  leaf_.resize(cells_.size());
  std::iota(order_.begin(), order_.end(), 0);
  build(0, size(), -1);
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

/// Cells within `radius` [mm] of a point: clusters no larger than `fine` [mm], or samples.
void SurfaceCover::gather(int index,
                          const Eigen::Vector3d& about,
                          double radius,
                          double fine,
                          std::vector<const SurfaceCell*>& cells) const {
  const Cluster& cluster = clusters_[at(index)];
  const auto reaches = [&](const SurfaceCell& cell) {
    const double reach = radius + cell.radius;
    return (cell.at.c - about).squaredNorm() < reach * reach;
  };
  if (!reaches(cluster.cell)) return;
  if (cluster.cell.radius < fine) return cells.push_back(&cluster.cell);
  if (cluster.child[0] >= 0) {
    for (const int child : cluster.child) gather(child, about, radius, fine, cells);
    return;
  }
  for (int k = cluster.first; k < cluster.last; ++k)
    if (reaches(cells_[at(in_order(k))])) cells.push_back(&cells_[at(in_order(k))]);
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

const SurfaceCover::Cluster& SurfaceCover::cluster_about(int sample, double radius) const {
  int index = leaf(sample);
  while (clusters_[at(index)].cell.radius < radius && clusters_[at(index)].parent >= 0)
    index = clusters_[at(index)].parent;
  return clusters_[at(index)];
}

/// The quadric of a cluster, from its samples or from clusters below it.
void SurfaceCover::enclose(Cluster& cluster, const SurfacePoint& middle) const {
  std::vector<const SurfaceCell*> cells;
  double radius = 0;
  for (int k = cluster.first; k < cluster.last; ++k)
    radius = std::max(radius, (sample(in_order(k)).c - middle.c).norm());
  if (cluster.child[0] < 0) {
    for (int k = cluster.first; k < cluster.last; ++k) cells.push_back(&cells_[at(in_order(k))]);
  } else {
    for (const int child : cluster.child) gather(child, middle.c, kInfinity, kFine * radius, cells);
  }
  cluster.cell = fit_quadric(middle, cells);
  const SurfacePoint& center = cluster.cell.at;
  for (int k = cluster.first; k < cluster.last; ++k) {
    const int i = in_order(k);
    cluster.change =
        std::max(cluster.change, tangent_change(sample(i).K, center.K, center.n) + change_[at(i)]);
  }
}

int SurfaceCover::build(int first, int last, int parent) {
  Cluster cluster;
  cluster.first = first;
  cluster.last = last;
  cluster.parent = parent;
  Eigen::AlignedBox3d box;
  Eigen::Vector3d numbers = Eigen::Vector3d::Zero();
  for (int k = first; k < last; ++k) {
    box.extend(sample(in_order(k)).c);
    numbers += place(in_order(k)) / (last - first);
  }
  const SurfacePoint middle = surface_->evaluate(surface_->place_of(numbers));
  const int index = static_cast<int>(clusters_.size());
  clusters_.push_back(cluster);
  if (last - first <= kLeafSize) {
    for (int k = first; k < last; ++k) leaf_[at(in_order(k))] = index;
    enclose(clusters_.back(), middle);
    return index;
  }
  Eigen::Index axis;
  box.sizes().maxCoeff(&axis);
  const int half = (first + last) / 2;
  std::nth_element(order_.begin() + first, order_.begin() + half, order_.begin() + last,
                   [&](int a, int b) { return sample(a).c[axis] < sample(b).c[axis]; });
  const int low = build(first, half, index), high = build(half, last, index);
  clusters_[at(index)].child = {low, high};
  enclose(clusters_[at(index)], middle);
  return index;
}

/// A shell about a point.
struct SurfaceCover::Range {
  const SurfacePoint& about;
  double own, from, to;
  [[nodiscard]] bool holds(double way, double radius) const {
    return way - radius - own <= to && way + radius + own >= from;
  }
};

void SurfaceCover::add_rise(int index, const Range& range, Rise& greatest) const {
  const Cluster& cluster = clusters_[at(index)];
  const auto add = [&](const SurfaceCell& cell, double change) {
    const Rise rise = rise_of(cell, change, range.about);
    greatest.over_quadric = std::max(greatest.over_quadric, rise.over_quadric);
    greatest.over_plane = std::max(greatest.over_plane, rise.over_plane);
  };
  const double way = (cluster.cell.at.c - range.about.c).norm();
  if (!range.holds(way, cluster.cell.radius)) return;
  if (cluster.cell.radius < kSmall * way && cluster.cell.rise < kInfinity)
    return add(cluster.cell, cluster.change);
  if (cluster.child[0] >= 0) {
    for (const int child : cluster.child) add_rise(child, range, greatest);
    return;
  }
  for (int k = cluster.first; k < cluster.last; ++k) {
    const auto i = at(in_order(k));
    if (range.holds((cells_[i].at.c - range.about.c).norm(), cells_[i].radius))
      add(cells_[i], change_[i]);
  }
}

Rise SurfaceCover::rise(const SurfacePoint& of, double own, double from, double to) const {
  Rise greatest = {-kInfinity, -kInfinity};
  if (!clusters_.empty()) add_rise(0, {of, own, from, to}, greatest);
  const double nearer = from > 0 ? 1 + own / from : 1;
  if (greatest.over_quadric > 0) greatest.over_quadric *= nearer * nearer;
  return greatest;
}

int SurfaceCover::nearest(const Eigen::Vector3d& point, int start) const {
  if (cells_.empty()) return -1;
  const auto beside = [&](int i) {
    return off_normal(point - sample(i).c, sample(i).n).squaredNorm();
  };
  const auto near = [&](int i) { return beside(i) < kLost * kLost * spacing_ * spacing_; };
  if (start >= 0) {
    const double within = kWithin * cell_radius(start);
    if (beside(start) < within * within) return start;
    int best = start;
    double square = (sample(best).c - point).squaredNorm();
    for (bool moved = true; moved;) {
      moved = false;
      for (const int other : neighbours(best)) {
        if (other < 0) break;
        const double d = (sample(other).c - point).squaredNorm();
        if (d >= square) continue;
        best = other;
        square = d;
        moved = true;
        break;
      }
    }
    if (near(best)) return best;
  }
  unsigned int index = 0;
  double square = 0;
  tree_->search.knnSearch(point.data(), 1, &index, &square);
  return near(static_cast<int>(index)) ? static_cast<int>(index) : -1;
}

}  // namespace condyle
