#include "condyle/equilibrium/path_follower.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace condyle {
namespace {

constexpr double kShortest = 1e-7;   // a step [L] below which the path counts as ended
constexpr double kMostOfStep = 1.5;  // that the swept value may go on in a step
constexpr const char* kEnds = "the path cannot be followed farther";

}  // namespace

PathFollower::PathFollower(EquilibriumSolver& solver,
                           const Swept& swept,
                           const Drive& drive,
                           double from,
                           double to,
                           double largest_step,
                           const PathOptions& options)
    : walker_(solver, swept, drive),
      model_(solver.model()),
      from_(from),
      to_(to),
      largest_step_(largest_step),
      options_(options),
      system_(model_, swept, drive, std::abs(to - from)),
      searches_(make_searches(model_, solver.covers())),
      rules_(model_, searches_) {
  system_.set_parameters(solver.parameters());
}

SweepResult PathFollower::follow() {
  SolvedPose first;
  walker_.step(from_, Patience::kAll, first);
  const bool converged = first.result.converged();
  told_ = first.result;
  append(std::move(first.result));
  if (!converged) return std::move(result_);
  point_ = {walker_.solver().state(), from_};
  if (!system_.tangent(point_, tangent_)) {
    stop("the path has no direction here");
    return std::move(result_);
  }
  if (tangent_.value() * (to_ - from_) < 0) reverse(tangent_);
  // A corner is turned without a pose.
  for (int steps = 0; static_cast<int>(result_.poses.size()) < options_.most_poses &&
                      steps < 4 * options_.most_poses;
       ++steps)
    if (!step()) return std::move(result_);
  stop(fmt::format("the path did not come to its end within {} poses", options_.most_poses));
  return std::move(result_);
}

void PathFollower::reverse(Direction& direction) {
  for (double& d : direction.d) d = -d;
}

void PathFollower::append(PoseResult pose) {
  if (options_.on_pose) options_.on_pose(pose);
  result_.poses.push_back(std::move(pose));
}

void PathFollower::stop(const std::string& why) {
  PoseResult pose;
  pose.value = point_.value;
  pose.status = PoseStatus::kIterationLimit;
  pose.reason = why;
  append(std::move(pose));
}

bool PathFollower::look_at(const PathPoint& point, SolvedPose& pose) {
  walker_.stand_at(point.value, point.state);
  return walker_.step(point.value, Patience::kNone, pose);
}

bool PathFollower::look_ahead(const PathPoint& point, double length, Ahead& ahead) {
  ahead.events.clear();
  ahead.usable = look_at(point, ahead.pose);
  return !ahead.usable || locate_changes(ahead.pose.result, length, ahead.events);
}

bool PathFollower::tell(Ahead ahead) {
  PoseResult& pose = ahead.pose.result;
  located_.insert(located_.end(), ahead.events.begin(), ahead.events.end());
  if (ahead.usable) {
    pose.trace.origin = PoseOrigin::kPath;
    told_ = pose;
  } else if (pose.reason.empty()) {
    pose.reason = kEnds;
  }
  append(std::move(pose));
  return ahead.usable;
}

double PathFollower::wanted_length() const {
  const double by_value = largest_step_ / std::max(1e-300, std::abs(tangent_.value()));
  return std::min(options_.longest * model_.length, by_value);
}

std::optional<PathPoint> PathFollower::at(double length) {
  PathPoint point = system_.ahead(point_, tangent_, length);
  if (!system_.correct(point, tangent_)) return std::nullopt;
  return point;
}

bool PathFollower::step() {
  const bool goes_on = try_step();
  std::stable_sort(located_.begin(), located_.end(),
                   [](const Located& a, const Located& b) { return a.length < b.length; });
  for (const Located& located : located_) result_.events.push_back(located.event);
  located_.clear();
  return goes_on;
}

bool PathFollower::try_step() {
  double length = wanted_length();
  std::optional<PathPoint> next;
  Direction next_tangent;
  Ahead ahead;
  std::optional<Bracket> change;  // of contacts
  bool near = false;              // where a path that turns has a corner
  for (;; length /= 2) {
    if (length < kShortest * model_.length) {
      stop(kEnds);
      return false;
    }
    if (!near && length < kCorner * model_.length) {
      near = true;
      if (turn_corner()) return true;
    }
    next = at(length);
    if (!next || !system_.tangent(*next, next_tangent)) continue;
    if (system_.product(next_tangent, tangent_) < 0) reverse(next_tangent);
    const bool at_corner = near && system_.distance(point_, *next) < 2 * length;
    if (at_corner) {
      (void)look_ahead(*next, length, ahead);
    } else if (!(system_.product(next_tangent, tangent_) > 0.8 &&
                 std::abs(next->value - point_.value) < kMostOfStep * largest_step_ &&
                 look_ahead(*next, length, ahead))) {
      // A path that turns much within a step was perhaps left for another, and beyond a corner its value may run away.
      continue;
    }
    if (!changes_at(*next).any()) break;
    change = first_change(length);
    // Where the way up to the change cannot be followed, the step has led to another path.
    if (at_corner || at(change->after)) break;
    change.reset();
  }
  if (change) length = change->after;
  const std::optional<Sample> last =
      change ? sample(length) : sample_of(length, *next, next_tangent);
  const std::vector<Sample> ways = last ? ways_to(*last) : std::vector<Sample>();
  const std::optional<double> end = length_to_end(ways);
  for (std::size_t i = 1; i + 1 < ways.size() && !(end && ways[i].length > *end); ++i) {
    const std::optional<PathPoint> limit = at(ways[i].length);
    if (limit && been_at(*limit)) return false;
    located_.push_back({ways[i].length, {ways[i].value, EventKind::kLimitPoint, -1}});
  }
  if (end) return finish(*end);
  if (!change) {
    if (!tell(std::move(ahead))) return false;
    point_ = *next;
    tangent_ = next_tangent;
    return true;
  }
  return change_contacts(*change);
}

std::optional<double> PathFollower::length_to_end(const std::vector<Sample>& ways) {
  for (std::size_t i = 0; i + 1 < ways.size(); ++i) {
    const double before = ways[i].value - to_;
    if (before * (ways[i + 1].value - to_) > 0 || before == 0) continue;
    double left = ways[i].length, right = ways[i + 1].length;
    for (int k = 0; k < 60 && right - left > 1e-6 * model_.length; ++k) {
      const double middle = 0.5 * (left + right);
      const std::optional<PathPoint> point = at(middle);
      if (!point) return std::nullopt;
      ((point->value - to_) * before > 0 ? left : right) = middle;
    }
    return right;
  }
  return std::nullopt;
}

bool PathFollower::finish(double length) {
  std::optional<PathPoint> last = at(length);
  if (last) last->value = to_;
  if (!last || !system_.correct(*last, tangent_, true)) {
    stop("the path turns back just where it was to end");
    return false;
  }
  last->value = to_;
  Ahead ahead;
  (void)look_ahead(*last, length, ahead);
  tell(std::move(ahead));
  return false;
}

}  // namespace condyle
