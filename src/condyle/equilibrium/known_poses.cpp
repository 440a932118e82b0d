#include "condyle/equilibrium/known_poses.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace condyle {
namespace {

constexpr double kRounding = 1e-12;

double value_of(const KnownPose* known) { return known->pose.value; }

/// +1 where the values only rise, -1 where they only fall, 0 else.
int direction(const std::vector<PoseResult>& poses) {
  bool rises = true, falls = true;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    rises &= poses[i].value > poses[i - 1].value;
    falls &= poses[i].value < poses[i - 1].value;
  }
  return rises ? 1 : falls ? -1 : 0;
}

/// Hands each event to the first solved pose that does not lie before it.
void hand_out_events(const std::vector<Event>& events, int rising, std::vector<KnownPose>& poses) {
  std::optional<double> before;
  std::size_t next = 0;
  for (KnownPose& known : poses) {
    if (!known.pose.solved()) continue;
    known.from = before;
    before = known.pose.value;
    for (; next < events.size() && rising * (events[next].value - *before) <= 0; ++next)
      known.events.push_back(events[next]);
  }
}

}  // namespace

bool same_value(double a, double b) {
  return std::abs(a - b) <= kRounding * std::max(1.0, std::abs(a));
}

std::vector<KnownPose> known_poses(const SweepResult& result) {
  std::vector<KnownPose> poses;
  std::unordered_map<double, int> visits;
  for (const PoseResult& pose : result.poses)
    poses.push_back({pose, visits[pose.value]++, {}, {}, false, false});
  if (const int rising = direction(result.poses)) hand_out_events(result.events, rising, poses);
  return poses;
}

KnownPoseIndex::KnownPoseIndex(const std::vector<KnownPose>& poses) {
  for (const KnownPose& known : poses)
    if (std::isfinite(known.pose.value)) by_value_.push_back(&known);
  std::stable_sort(by_value_.begin(), by_value_.end(), [](const KnownPose* a, const KnownPose* b) {
    return value_of(a) < value_of(b);
  });
}

const KnownPose* KnownPoseIndex::find(double value, int visit) const {
  const double least = value - 2 * kRounding * std::max(1.0, std::abs(value));
  const KnownPose* found = nullptr;
  for (auto at = std::ranges::lower_bound(by_value_, least, {}, value_of);
       at != by_value_.end() && (value_of(*at) < value || same_value(value, value_of(*at))); ++at) {
    if (same_value(value, value_of(*at)) && (*at)->visit == visit) found = *at;
  }
  return found;
}

const KnownPose* KnownPoseIndex::nearest_converged(double value) const {
  const auto above = std::ranges::lower_bound(by_value_, value, {}, value_of);
  const auto converged = [](const KnownPose* known) { return known->pose.converged(); };
  const auto right = std::find_if(above, by_value_.end(), converged);
  const auto left = std::find_if(std::make_reverse_iterator(above), by_value_.rend(), converged);
  if (left == by_value_.rend()) return right == by_value_.end() ? nullptr : *right;
  if (right == by_value_.end()) return *left;
  return value - value_of(*left) <= value_of(*right) - value ? *left : *right;
}

}  // namespace condyle
