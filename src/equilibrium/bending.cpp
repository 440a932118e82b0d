#include "equilibrium/bending.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "surface/point_tree.h"

namespace condyle {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kSafety = 1.3;  // the quadric meant is that of a point near the sample

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

double BendingMeter::at(const Eigen::Vector3d& point,
                        const Eigen::Vector3d& normal,
                        double least) const {
  if (n_.dot(normal) < 0.5) return kInfinity;
  const Eigen::Vector3d d = point - c_;
  const double height = n_.dot(d);
  const Eigen::Vector3d t = d - height * n_;
  const double square = std::max(t.squaredNorm(), least * least);
  return std::abs(2 * height - t.dot(K_ * t)) / square;
}

Bending::Bending(const Surface& surface, double spacing) : even_(surface.bends_evenly()) {
  for (int level = 0; level < kLevels; ++level)
    radii_[level] = spacing * std::pow(2, kLevels - 1 - level);
  std::vector<Eigen::Vector3d> points;
  for (const Place& place : surface.samples(spacing)) {
    samples_.push_back(surface.evaluate(place));
    points.push_back(samples_.back().c);
  }
  neighbours_ = nearest_neighbours(points, 3 * spacing);
  allowance_.resize(samples_.size());
  for (auto& of : allowance_) of.fill(-1);
}

void Bending::measure(std::size_t sample) {
  const SurfacePoint& at = samples_[sample];
  const double least = radii_[kLevels - 1];
  const BendingMeter meter(at.c, at.n, at.K);
  std::array<double, kLevels>& of = allowance_[sample];
  of.fill(0);
  for (const SurfacePoint& other : samples_) {
    const double square = (other.c - at.c).squaredNorm();
    if (square > radii_[0] * radii_[0] || &other == &at) continue;
    const double a = kSafety * meter.at(other.c, other.n, least);
    for (int level = 0; level < kLevels && square <= radii_[level] * radii_[level]; ++level)
      of[level] = std::max(of[level], a);
  }
  // A level whose ring holds no samples knows nothing of its own: that of the next one serves.
  for (int level = 1; level < kLevels; ++level)
    if (of[level] == 0) of[level] = of[level - 1];
}

int Bending::nearest(const Eigen::Vector3d& point, int start) const {
  if (samples_.empty()) return -1;
  int best = std::max(start, 0);
  double square = (samples_[best].c - point).squaredNorm();
  for (bool moved = true; moved;) {
    moved = false;
    for (const int other : neighbours_[best]) {
      if (other < 0) break;
      const double d = (samples_[other].c - point).squaredNorm();
      if (d >= square) continue;
      best = other;
      square = d;
      moved = true;
      break;
    }
  }
  const double lost = 2 * radii_[kLevels - 1];
  if (square < lost * lost) return best;
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    const double d = (samples_[i].c - point).squaredNorm();
    if (d < square) best = static_cast<int>(i), square = d;
  }
  return best;
}

double Bending::within(double radius, int sample, const Eigen::Matrix3d& K) {
  if (even_) {
    // A ball of radius R departs by t⁴/(8 R³) and more, at t = R by R/2; |K| = √2/R.
    const double k = K.norm();
    return 0.5 * k * (radius * k) * (radius * k);
  }
  if (sample < 0) return kInfinity;
  const auto index = static_cast<std::size_t>(sample);
  if (allowance_[index][0] < 0) measure(index);
  int level = kLevels - 1;
  while (level > 0 && radii_[level] < radius) --level;
  return radii_[level] < radius ? kInfinity : allowance_[index][level];
}

}  // namespace condyle
