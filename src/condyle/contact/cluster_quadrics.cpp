#include "condyle/contact/cluster_quadrics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "condyle/contact/curvature_tensor.h"

namespace condyle {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kFine = 0.36;    // of a cluster's radius: that of the pieces it is fitted to
constexpr int kSome = 64;         // samples show the shape of a cluster as well as all of them
constexpr double kSmall = 0.125;  // a cluster counts as one cell below this share of its way

std::size_t at(int index) { return static_cast<std::size_t>(index); }

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

ClusterQuadrics::ClusterQuadrics(const SurfaceCover& cover)
    : cover_(&cover),
      fits_(cover.clusters().size()),
      fitted_(cover.clusters().size(), 0),
      means_(cover.clusters().size()),
      has_mean_(cover.clusters().size(), 0) {
  pieces_.reserve(at(cover.size()));
}

const ClusterQuadric& ClusterQuadrics::of(int cluster) {
  if (!fitted_[at(cluster)]) fit(cluster);
  return fits_[at(cluster)];
}

const SurfacePoint& ClusterQuadrics::mean_about(int sample, double radius) {
  int index = cover_->leaf(sample);
  while (cover_->cluster(index).radius < radius && cover_->cluster(index).parent >= 0)
    index = cover_->cluster(index).parent;
  if (!has_mean_[at(index)]) {
    const SurfaceCover::Cluster& cluster = cover_->cluster(index);
    const int step = 1 + (cluster.last - cluster.first) / kSome;
    for (int k = cluster.first; k < cluster.last; k += step)
      pieces_.push_back(&cover_->cell(cover_->in_order(k)));
    means_[at(index)] = fit_quadric(cover_->sample(sample_amid(cluster)), pieces_).at;
    pieces_.clear();
    has_mean_[at(index)] = 1;
  }
  return means_[at(index)];
}

/// The sample nearest to the centre.
int ClusterQuadrics::sample_amid(const SurfaceCover::Cluster& cluster) const {
  int amid = cover_->in_order(cluster.first);
  double least = kInfinity;
  for (int k = cluster.first; k < cluster.last; ++k) {
    const int i = cover_->in_order(k);
    const double square = (cover_->sample(i).c - cluster.center).squaredNorm();
    if (square >= least) continue;
    least = square;
    amid = i;
  }
  return amid;
}

/// Clusters no larger than `fine` [mm] below this one, or samples: what a quadric is fitted to.
void ClusterQuadrics::gather(int index, double fine) {
  const SurfaceCover::Cluster& cluster = cover_->cluster(index);
  if (cluster.radius < fine) return pieces_.push_back(&of(index).cell);
  if (cluster.child[0] >= 0) {
    for (const int child : cluster.child) gather(child, fine);
    return;
  }
  for (int k = cluster.first; k < cluster.last; ++k)
    pieces_.push_back(&cover_->cell(cover_->in_order(k)));
}

void ClusterQuadrics::fit(int index) {
  const SurfaceCover::Cluster& cluster = cover_->cluster(index);
  const std::size_t begin = pieces_.size();
  gather(index, kFine * cluster.radius);
  ClusterQuadric& quadric = fits_[at(index)];
  quadric.cell =
      fit_quadric(cover_->sample(sample_amid(cluster)), std::span(pieces_).subspan(begin));
  pieces_.resize(begin);
  const SurfacePoint& center = quadric.cell.at;
  for (int k = cluster.first; k < cluster.last; ++k) {
    const int i = cover_->in_order(k);
    quadric.change =
        std::max(quadric.change,
                 tangent_change(cover_->sample(i).K, center.K, center.n) + cover_->cell_change(i));
  }
  fitted_[at(index)] = 1;
}

/// A shell about a point.
struct ClusterQuadrics::Range {
  const SurfacePoint& about;
  double own, from, to;
  [[nodiscard]] double way(const Eigen::Vector3d& c) const { return (c - about.c).norm(); }
  [[nodiscard]] bool holds(double way, double radius) const {
    return way - radius - own <= to && way + radius + own >= from;
  }
};

void ClusterQuadrics::add_rise(int index, const Range& range, Rise& greatest) {
  const SurfaceCover::Cluster& cluster = cover_->cluster(index);
  const auto add = [&](const SurfaceCell& cell, double change) {
    const Rise rise = rise_of(cell, change, range.about);
    greatest.over_quadric = std::max(greatest.over_quadric, rise.over_quadric);
    greatest.over_plane = std::max(greatest.over_plane, rise.over_plane);
  };
  const double way = range.way(cluster.center);
  if (!range.holds(way, cluster.radius)) return;
  if (cluster.radius < kSmall * way) {
    const ClusterQuadric& quadric = of(index);
    if (quadric.cell.rise < kInfinity) {
      if (range.holds(range.way(quadric.cell.at.c), quadric.cell.radius))
        add(quadric.cell, quadric.change);
      return;
    }
  }
  if (cluster.child[0] >= 0) {
    for (const int child : cluster.child) add_rise(child, range, greatest);
    return;
  }
  for (int k = cluster.first; k < cluster.last; ++k) {
    const int i = cover_->in_order(k);
    const SurfaceCell& cell = cover_->cell(i);
    if (range.holds(range.way(cell.at.c), cell.radius)) add(cell, cover_->cell_change(i));
  }
}

Rise ClusterQuadrics::rise(const SurfacePoint& of, double own, double from, double to) {
  Rise greatest = {-kInfinity, -kInfinity};
  if (!cover_->clusters().empty()) add_rise(0, {of, own, from, to}, greatest);
  const double nearer = from > 0 ? 1 + own / from : 1;
  if (greatest.over_quadric > 0) greatest.over_quadric *= nearer * nearer;
  return greatest;
}

}  // namespace condyle
