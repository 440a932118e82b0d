#include "equilibrium/bending.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "surface/point_tree.h"

namespace condyle {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kSafety = 1.3;      // the quadric meant is that of a point near the sample
constexpr double kNeighbours = 1.6;  // radius of the first shell, in spacings

/// Of a plane, sphere or cylinder as far as `radius` from any of its points. A cup of radius R
/// rises to h = d²/2R at the distance d from its point, so 2 h/t² = 1/R (1 - d²/4R²).
Rise even_rise(double radius, const Eigen::Matrix3d& K) {
  const double trace = K.trace();
  const double greatest =
      0.5 * (trace + std::sqrt(std::max(0.0, 2 * K.squaredNorm() - trace * trace)));
  if (trace <= 0) return {0, greatest};
  const double x = 0.5 * radius * greatest;
  if (x > 0.9) return {kInfinity, kInfinity};
  const double rise = greatest / (1 - x * x);
  return {rise - greatest, rise};
}

}  // namespace

std::vector<std::array<int, 8>> nearest_neighbours(const std::vector<Eigen::Vector3d>& points,
                                                   double radius) {
  std::vector<std::array<int, 8>> neighbours(points.size());
  for (auto& list : neighbours) list.fill(-1);
  if (points.empty()) return neighbours;
  const PointCloud cloud{points};
  const PointTree tree(3, cloud);
  std::array<unsigned int, 9> index;
  std::array<double, 9> square;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t found = tree.knnSearch(points[i].data(), 9, index.data(), square.data());
    int k = 0;
    for (std::size_t j = 0; j < found && k < 8; ++j)
      if (index[j] != static_cast<unsigned int>(i) && square[j] < radius * radius)
        neighbours[i][k++] = static_cast<int>(index[j]);
  }
  return neighbours;
}

/// With its points, so that it stays where a search moves.
struct Bending::Tree {
  explicit Tree(std::vector<Eigen::Vector3d> of)
      : points(std::move(of)), cloud{points}, search(3, cloud) {}
  std::vector<Eigen::Vector3d> points;
  PointCloud cloud;
  PointTree search;
};

Rise BendingMeter::at(const Eigen::Vector3d& point,
                      const Eigen::Vector3d& normal,
                      double least) const {
  const Eigen::Vector3d d = point - c_;
  const double height = n_.dot(d);
  const Eigen::Vector3d t = d - height * n_;
  const double inverse = 1 / std::max(t.squaredNorm(), least * least);
  return {n_.dot(normal) < 0.5 ? kInfinity : (2 * height - t.dot(K_ * t)) * inverse,
          2 * height * inverse};
}

Bending::Radii Bending::shells(double spacing, double greatest) {
  const double least = kNeighbours * spacing;
  const double ratio = std::pow(std::max(greatest / least, 1.0), 1.0 / (kLevels - 1));
  Radii radii;
  for (int level = 0; level < kLevels; ++level) radii[level] = least * std::pow(ratio, level);
  return radii;
}

Bending::Bending(const Surface& surface, double spacing, const Radii& radii)
    : radii_(radii), even_(surface.bends_evenly()) {
  std::vector<Eigen::Vector3d> points;
  for (const Place& place : surface.samples(spacing)) {
    samples_.push_back(surface.evaluate(place));
    points.push_back(samples_.back().c);
    normals_.push_back(samples_.back().n);
  }
  neighbours_ = nearest_neighbours(points, 3 * spacing);
  if (!points.empty()) tree_ = std::make_shared<const Tree>(std::move(points));
  shells_.resize(samples_.size());
  for (Shells& shells : shells_) shells.within[0] = -1;
}

const std::vector<Eigen::Vector3d>& Bending::points() const { return tree_->points; }

void Bending::measure(std::size_t sample) {
  const SurfacePoint& at = samples_[sample];
  const double least = radii_[0] / kNeighbours;
  const BendingMeter meter(at.c, at.n, at.K);
  Shells& shells = shells_[sample];
  shells.of.fill({-kInfinity, -kInfinity});
  const std::vector<Eigen::Vector3d>& points = this->points();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double square = (points[i] - at.c).squaredNorm();
    int level = 0;
    while (level < kLevels && square > radii_[level] * radii_[level]) ++level;
    if (level == kLevels || i == sample) continue;
    const Rise rise = meter.at(points[i], normals_[i], least);
    Rise& greatest = shells.of[level];
    greatest.over_quadric = std::max(greatest.over_quadric, rise.over_quadric);
    greatest.over_plane = std::max(greatest.over_plane, rise.over_plane);
  }
  double so_far = 0;
  for (int level = 0; level < kLevels; ++level) {
    Rise& rise = shells.of[level];
    if (rise.over_quadric > 0) rise.over_quadric *= kSafety;
    so_far = std::max(so_far, rise.over_quadric);
    shells.within[level] = so_far;
  }
}

int Bending::nearest(const Eigen::Vector3d& point, int start) const {
  if (samples_.empty()) return -1;
  const std::vector<Eigen::Vector3d>& points = this->points();
  int best = std::max(start, 0);
  double square = (points[best] - point).squaredNorm();
  for (bool moved = true; moved;) {
    moved = false;
    for (const int other : neighbours_[best]) {
      if (other < 0) break;
      const double d = (points[other] - point).squaredNorm();
      if (d >= square) continue;
      best = other;
      square = d;
      moved = true;
      break;
    }
  }
  const double lost = 2 * radii_[0] / kNeighbours;
  if (square < lost * lost) return best;
  unsigned int index = 0;
  tree_->search.knnSearch(point.data(), 1, &index, &square);
  return square < lost * lost ? static_cast<int>(index) : -1;
}

double Bending::within(double radius, int sample, const Eigen::Matrix3d& K) {
  if (even_) return even_rise(radius, K).over_quadric;
  if (sample < 0) return kInfinity;
  const auto index = static_cast<std::size_t>(sample);
  if (shells_[index].within[0] < 0) measure(index);
  int level = 0;
  while (level < kLevels && radii_[level] < radius) ++level;
  return level == kLevels ? kInfinity : shells_[index].within[level];
}

Rise Bending::in_shell(int level, int sample, const Eigen::Matrix3d& K) {
  if (even_) return even_rise(radii_[level], K);
  if (sample < 0) return {kInfinity, kInfinity};
  const auto index = static_cast<std::size_t>(sample);
  if (shells_[index].within[0] < 0) measure(index);
  return shells_[index].of[level];
}

}  // namespace condyle
