/// What happens on a path of equilibria between one of its points and the next.

#include "condyle/equilibrium/path_follower.h"
#include "condyle/equilibrium/pose_changes.h"

namespace condyle {
namespace {

constexpr double kLocated = 1e-9;  // of a place on the path [L]
constexpr int kMostChanges = 16;   // that are located in one step

}  // namespace

void PathFollower::locate_limit(double length, const Direction& end) {
  if (tangent_.value() * end.value() >= 0) return;
  double left = 0, right = length;
  double value = point_.value;
  while (right - left > kLocated * model_.length) {
    const double middle = 0.5 * (left + right);
    const std::optional<PathPoint> point = at(middle);
    Direction tangent;
    if (!point || !system_.tangent(*point, tangent)) return;
    if (system_.product(tangent, tangent_) < 0) reverse(tangent);
    (tangent.value() * tangent_.value() > 0 ? left : right) = middle;
    value = point->value;
  }
  located_.push_back({right, {value, EventKind::kLimitPoint, -1}});
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
  return followed;
}

}  // namespace condyle
