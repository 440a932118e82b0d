#include "condyle/contact/nearest_sample.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "condyle/contact/curvature_tensor.h"
#include "condyle/math/simd.h"

namespace condyle {
namespace {

constexpr double kLost = 2.5;    // beside a sample farther than this, in spacings: beyond
constexpr double kWithin = 0.7;  // of the radius of a cell: well within
constexpr double kThin = 1.5;    // sample spacings: sheets of a surface are farther apart
constexpr double kSurely = 0.9;  // of the radius of a ball, which samples tell
constexpr double kSame = 0.95;   // of a radius or distance, which need not be known better
constexpr double kFirst = 4,
                 kMore = 4;     // spacings, and times those, that are asked for one after the other
constexpr double kMost = 8;     // extents of the surface: more is without end
constexpr long kMeasuring = 8;  // points of a surface that this takes the time of, about

/// Radius of the ball that touches a plane with the normal n at the origin and goes through d.
double ball_through(const Eigen::Vector3d& d, const Eigen::Vector3d& n) {
  const double height = n.dot(d);
  return height > 0 ? d.squaredNorm() / (2 * height) : std::numeric_limits<double>::infinity();
}

/// No such ball is smaller through any point within `spread` of d.
double least_ball(const Eigen::Vector3d& d, const Eigen::Vector3d& n, double spread) {
  const double way = d.norm() - spread, height = n.dot(d) + spread;
  if (way <= 0) return 0;
  return height > 0 ? way * way / (2 * height) : std::numeric_limits<double>::infinity();
}

}  // namespace

NearestSample::NearestSample(const SurfaceCover& cover) : cover_(&cover) {
  for (std::vector<Ball>& balls : balls_) balls.resize(static_cast<std::size_t>(cover.size()));
}

CONDYLE_FMA_CLONE
int NearestSample::find(const Eigen::Vector3d& point, int& from, long& looked_at) {
  const SurfaceCover& cover = *cover_;
  if (cover.size() == 0) return -1;
  const auto way = [&](int i) -> Eigen::Vector3d { return point - cover.sample(i).c; };
  const auto beside = [&](int i) { return off_normal(way(i), cover.sample(i).n).squaredNorm(); };
  const auto is_near = [&](int i) {
    const double lost = kLost * cover.spacing();
    return beside(i) < lost * lost;
  };
  const auto is_sure = [&](int i) { return holds(i, way(i).dot(cover.sample(i).n), looked_at); };
  double within = std::numeric_limits<double>::infinity();
  if (from >= 0) {
    const double cell = kWithin * cover.cell_radius(from);
    if (beside(from) < cell * cell && is_sure(from)) return from;
    double square = way(from).squaredNorm();
    for (bool moved = true; moved;) {
      moved = false;
      for (const int other : cover.neighbours(from)) {
        if (other < 0) break;
        const double d = way(other).squaredNorm();
        if (d >= square) continue;
        from = other;
        square = d;
        moved = true;
        break;
      }
    }
    if (is_near(from) && is_sure(from)) return from;
    within = kSame * std::sqrt(square);
  }
  const int nearer = cover.nearest_within(point, within, looked_at);
  if (nearer >= 0) from = nearer;
  return is_near(from) ? from : -1;
}

bool NearestSample::holds(int sample, double along, long& looked_at) {
  if (std::abs(along) < kThin * cover_->spacing()) return true;
  Ball& ball = balls_[along > 0 ? 0 : 1][static_cast<std::size_t>(sample)];
  if (ball.counted != now_) looked_at += kMeasuring;
  ball.counted = now_;
  const double needed = std::abs(along) / kSurely;
  const double most = kMost * cover_->extent();
  while (ball.radius <= needed && ball.radius == ball.asked && ball.asked < most) {
    const Eigen::Vector3d& n = cover_->sample(sample).n;
    ball.asked = std::max(kMore * ball.asked, kFirst * cover_->spacing());
    ball.radius = measure(sample, along > 0 ? n : Eigen::Vector3d(-n), ball.asked);
  }
  return needed < ball.radius;
}

double NearestSample::measure(int sample, const Eigen::Vector3d& n, double most) const {
  double radius = most;
  shrink(0, cover_->sample(sample), n, radius);
  return radius;
}

/// To the smallest ball through a sample of the cluster, to within kSame.
void NearestSample::shrink(int index,
                           const SurfacePoint& at,
                           const Eigen::Vector3d& n,
                           double& radius) const {
  const SurfaceCover::Cluster& cluster = cover_->cluster(index);
  if (cluster.child[0] < 0) {
    for (int k = cluster.first; k < cluster.last; ++k)
      radius = std::min(radius, ball_through(cover_->sample(cover_->in_order(k)).c - at.c, n));
    return;
  }
  const auto bound = [&](int child) {
    const SurfaceCover::Cluster& there = cover_->cluster(child);
    return std::pair(least_ball(there.center - at.c, n, there.spread), child);
  };
  std::pair<double, int> first = bound(cluster.child[0]), second = bound(cluster.child[1]);
  if (second < first) std::swap(first, second);
  for (const auto& [least, child] : {first, second})
    if (least < kSame * radius) shrink(child, at, n, radius);
}

}  // namespace condyle
