#include "condyle/contact/medial_reach.h"

#include <cmath>

namespace condyle {
namespace {

constexpr double kThin = 1;      // sample spacings: sheets of a surface are farther apart
constexpr double kSame = 0.95;   // of a radius, which need not be known better
constexpr double kSurely = 0.9;  // of the reach, which samples tell

}  // namespace

MedialReach::MedialReach(const SurfaceCover& cover) : cover_(&cover) {
  for (std::vector<Reach>& reach : reach_) reach.resize(static_cast<std::size_t>(cover.size()));
}

bool MedialReach::holds(int sample, double along, long& looked_at) {
  if (std::abs(along) < kThin * cover_->spacing()) return true;
  Reach& reach = reach_[along > 0 ? 0 : 1][static_cast<std::size_t>(sample)];
  if (reach.counted != now_) {
    if (reach.radius < 0) reach = measure(sample, along > 0 ? 1 : -1);
    reach.counted = now_;
    looked_at += reach.looked_at;
  }
  return std::abs(along) < kSurely * reach.radius;
}

MedialReach::Reach MedialReach::measure(int sample, double side) const {
  constexpr int kSteps = 30;
  const SurfacePoint& at = cover_->sample(sample);
  const Eigen::Vector3d n = side * at.n;
  Reach reach{4 * cover_->extent()};
  for (int step = 0; step < kSteps; ++step) {
    const double r = reach.radius;
    const int other = cover_->nearest_within(at.c + r * n, kSame * r, reach.looked_at);
    if (other < 0) break;
    const Eigen::Vector3d d = cover_->sample(other).c - at.c;
    reach.radius = d.squaredNorm() / (2 * n.dot(d));
  }
  return reach;
}

}  // namespace condyle
