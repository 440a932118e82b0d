/// What happens on a path of equilibria between one of its points and the next.

#include <algorithm>
#include <cmath>

#include "condyle/equilibrium/path_follower.h"
#include "condyle/equilibrium/pose_changes.h"

namespace condyle {
namespace {

constexpr double kLocated = 1e-9;  // of a place on the path [L]
constexpr int kMostChanges = 64;   // that are located in one step; further ones are told at its end

}  // namespace

PathFollower::Sample PathFollower::sample_of(double length,
                                             const PathPoint& point,
                                             const Direction& tangent) const {
  // Points ahead lie at right angles to the tangent here, so that ds along the path is ds/(t.t0) of it.
  return {length, point.value, tangent.value() / system_.product(tangent, tangent_)};
}

std::optional<PathFollower::Sample> PathFollower::sample(double length) {
  const std::optional<PathPoint> point = at(length);
  Direction tangent;
  if (!point || !system_.tangent(*point, tangent)) return std::nullopt;
  return sample_of(length, *point, tangent);
}

std::vector<PathFollower::Sample> PathFollower::ways_to(const Sample& end) {
  constexpr int kHalvings = 6;
  std::vector<Sample> ways = {{0, point_.value, tangent_.value()}};
  find_limits(ways.front(), end, kHalvings, ways);
  ways.push_back(end);
  return ways;
}

// Where the rate has one sign at both ends it may have the other between: as long as the cubic through both comes near to
// that, the half-way point is asked.
void PathFollower::find_limits(const Sample& left,
                               const Sample& right,
                               int halvings,
                               std::vector<Sample>& ways) {
  constexpr double kNear = 0.3;  // of the greater rate
  const double h = right.length - left.length;
  if (left.rate * right.rate < 0) {
    Sample a = left, b = right;
    while (b.length - a.length > kLocated * model_.length) {
      const std::optional<Sample> middle = sample(0.5 * (a.length + b.length));
      if (!middle) return;
      (middle->rate * left.rate > 0 ? a : b) = *middle;
    }
    return ways.push_back(b);
  }
  const double mean = (right.value - left.value) / h;
  const double c2 = 3 * (left.rate + right.rate - 2 * mean),
               c1 = 6 * mean - 4 * left.rate - 2 * right.rate;
  const double sense = left.rate + right.rate < 0 ? -1 : 1;
  double least = std::min(sense * left.rate, sense * right.rate);
  const double t = c2 != 0 ? -c1 / (2 * c2) : -1;
  if (t > 0 && t < 1) least = std::min(least, sense * (left.rate + t * (c1 + t * c2)));
  if (halvings == 0 || least > kNear * std::max(std::abs(left.rate), std::abs(right.rate))) return;
  const std::optional<Sample> middle = sample(0.5 * (left.length + right.length));
  if (!middle) return;
  find_limits(left, *middle, halvings - 1, ways);
  find_limits(*middle, right, halvings - 1, ways);
}

std::vector<Event> PathFollower::changes(const PoseResult& before,
                                         const PoseResult& after,
                                         double value) const {
  std::vector<Event> events;
  append_changes(before, after, value, events);
  std::erase_if(events, [&](const Event& event) {
    return (event.kind == EventKind::kClosing || event.kind == EventKind::kOpening) &&
           !model_.pairs[static_cast<std::size_t>(event.contact)].law;
  });
  return events;
}

bool PathFollower::locate_changes(const PoseResult& last,
                                  double length,
                                  std::vector<Located>& located) {
  if (!told_) return true;
  bool followed = true;
  PoseResult from = *told_;
  double begin = 0;
  for (int k = 0; k < kMostChanges && !changes(from, last, 0).empty(); ++k) {
    double left = begin, right = length;
    PoseResult after = last;
    SolvedPose trial;
    while (right - left > kLocated * model_.length) {
      const double middle = 0.5 * (left + right);
      const std::optional<PathPoint> point = at(middle);
      if (!point || !look_at(*point, trial)) {
        followed = false;
        break;
      }
      const bool changed = !changes(from, trial.result, 0).empty();
      (changed ? right : left) = middle;
      if (changed) after = trial.result;
    }
    for (const Event& event : changes(from, after, after.value)) located.push_back({right, event});
    from = std::move(after);
    begin = right;
  }
  for (const Event& event : changes(from, last, last.value)) located.push_back({length, event});
  return followed;
}

}  // namespace condyle
