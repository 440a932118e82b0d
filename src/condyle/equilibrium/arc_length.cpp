#include "condyle/equilibrium/arc_length.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "condyle/contact/contact_scales.h"
#include "condyle/equilibrium/contact_rules.h"
#include "condyle/equilibrium/walker.h"

namespace condyle {
namespace {

constexpr double kShortest = 1e-7;  // a step [L] below which the path counts as ended

class PathFollower {
 public:
  PathFollower(EquilibriumSolver& solver,
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

  SweepResult follow() {
    SolvedPose first;
    walker_.step(from_, Patience::kAll, first);
    const bool converged = first.result.converged();
    append(std::move(first.result));
    if (!converged) return std::move(result_);
    point_ = {walker_.solver().state(), from_};
    if (!system_.tangent(point_, tangent_)) {
      stop("the path has no direction here");
      return std::move(result_);
    }
    if (tangent_.value() * (to_ - from_) < 0) reverse(tangent_);
    while (static_cast<int>(result_.poses.size()) < options_.most_poses) {
      if (!step()) return std::move(result_);
    }
    stop(fmt::format("the path did not come to its end within {} poses", options_.most_poses));
    return std::move(result_);
  }

 private:
  using Direction = PathSystem::Direction;

  static void reverse(Direction& direction) {
    for (double& d : direction.d) d = -d;
  }

  void append(PoseResult pose) {
    if (options_.on_pose) options_.on_pose(pose);
    result_.poses.push_back(std::move(pose));
  }

  void stop(const std::string& why) {
    PoseResult pose;
    pose.value = point_.value;
    pose.status = PoseStatus::kIterationLimit;
    pose.reason = why;
    append(std::move(pose));
  }

  /// The pose at a point, with all that is told about it.
  bool describe(const PathPoint& point) {
    SolvedPose pose;
    walker_.stand_at(point.value, point.state);
    const bool usable = walker_.step(point.value, Patience::kNone, pose);
    if (usable) pose.result.trace.origin = PoseOrigin::kPath;
    append(std::move(pose.result));
    return usable;
  }

  [[nodiscard]] double wanted_length() const {
    const double by_value = largest_step_ / std::max(1e-300, std::abs(tangent_.value()));
    return std::min(options_.longest * model_.length, by_value);
  }

  /// The point of the path some length ahead of the present one.
  std::optional<PathPoint> at(double length) {
    PathPoint point = system_.ahead(point_, tangent_, length);
    if (!system_.correct(point, tangent_)) return std::nullopt;
    return point;
  }

  ContactChanges changes_at(const PathPoint& point) {
    if (!system_.assemble(point)) return {};
    return rules_.changes(system_.linearization(point));
  }

  /// One pose further; false at the end of the path.
  bool step() {
    double length = wanted_length();
    std::optional<PathPoint> next;
    Direction next_tangent;
    for (;; length /= 2) {
      if (length < kShortest * model_.length) {
        stop(fmt::format("the path cannot be followed beyond {:.9g}", point_.value));
        return false;
      }
      next = at(length);
      if (!next || !system_.tangent(*next, next_tangent)) continue;
      if (system_.product(next_tangent, tangent_) < 0) reverse(next_tangent);
      // A path that turns much within a step was perhaps left for another.
      if (system_.product(next_tangent, tangent_) > 0.8) break;
    }
    const bool changes = changes_at(*next).any();
    if (changes) length = last_without_change(length);
    if (const std::optional<double> end = length_to_end(length)) return finish(*end, length);
    if (!changes) {
      locate_limit(length, next_tangent);
      if (!describe(*next)) return false;
      locate_touches(length);
      point_ = *next;
      tangent_ = next_tangent;
      return true;
    }
    return change_contacts(length);
  }

  /// Bisection for the length up to which contacts push and nothing overlaps.
  double last_without_change(double length) {
    double good = 0, bad = length;
    while (bad - good > 1e-12 * model_.length + 1e-14 * length) {
      const double middle = 0.5 * (good + bad);
      const std::optional<PathPoint> point = at(middle);
      (point && !changes_at(*point).any() ? good : bad) = middle;
    }
    return bad;
  }

  /// Releases the contact that pulls at `length`, or closes the one that overlaps there, and turns
  /// into the branch that agrees with it.
  bool change_contacts(double length) {
    const std::optional<PathPoint> there = at(length);
    const ContactChanges changes = there ? changes_at(*there) : ContactChanges();
    if (!changes.any()) {
      stop(fmt::format("contacts could not be followed beyond {:.9g}", point_.value));
      return false;
    }
    Direction before;
    system_.tangent(*there, before);
    if (system_.product(before, tangent_) < 0) reverse(before);
    PathPoint changed = *there;
    const bool closes = changes.opens < 0;
    const EventKind kind = closes ? EventKind::kClosing : EventKind::kOpening;
    const ClosedContact& contact =
        closes ? changes.closes[changes.deepest]
               : there->state.contacts[static_cast<std::size_t>(changes.opens)];
    const int pair = contact.pair;
    Direction after;
    if (!(closes ? close(contact, changed, after) : release(changes.opens, changed, after))) {
      stop(fmt::format("no way on was found where contact \"{}\" is {} at {:.9g}",
                       model_.pairs[static_cast<std::size_t>(pair)].name, name(kind),
                       changed.value));
      return false;
    }
    locate_limit(length, before);
    result_.events.push_back({changed.value, kind, pair});
    if (after.value() * before.value() < 0)
      result_.events.push_back({changed.value, EventKind::kLimitPoint, -1});
    point_ = changed;
    tangent_ = after;
    return true;
  }

  bool release(int contact, PathPoint& point, Direction& tangent) {
    system_.assemble(point);
    const ContactLinearization open =
        system_.linearization(point).contacts()[static_cast<std::size_t>(contact)];
    point.state.contacts.erase(point.state.contacts.begin() + contact);
    if (!settle(point, tangent)) return false;
    if (system_.gap_rate(open, tangent) < 0) reverse(tangent);
    return true;
  }

  bool close(const ClosedContact& contact, PathPoint& point, Direction& tangent) {
    if (point.state.contacts.size() + point.state.sigma.size() >= kMaxConstraints) return false;
    point.state.contacts.push_back(contact);
    if (!settle(point, tangent)) return false;
    // Back to where the contact touches without force: the search told of it a little later.
    const std::size_t last = point.state.contacts.size() - 1;
    const double rate = tangent.force(last), force = point.state.contacts[last].p;
    if (rate == 0) return false;
    point = system_.ahead(point, tangent, -force / rate);
    if (rate < 0) reverse(tangent);
    return system_.correct(point, tangent);
  }

  /// Back to equilibrium with changed contacts, along the new path's own normal.
  bool settle(PathPoint& point, Direction& tangent) {
    return system_.tangent(point, tangent) && system_.correct(point, tangent) &&
           system_.tangent(point, tangent);
  }

  /// Where the swept value stops growing between here and `length`, or begins to.
  void locate_limit(double length, const Direction& end) {
    if (tangent_.value() * end.value() >= 0) return;
    double left = 0, right = length;
    double value = point_.value;
    while (right - left > 1e-9 * model_.length) {
      const double middle = 0.5 * (left + right);
      const std::optional<PathPoint> point = at(middle);
      Direction tangent;
      if (!point || !system_.tangent(*point, tangent)) return;
      if (system_.product(tangent, tangent_) < 0) reverse(tangent);
      (tangent.value() * tangent_.value() > 0 ? left : right) = middle;
      value = point->value;
    }
    result_.events.push_back({value, EventKind::kLimitPoint, -1});
  }

  /// Where pairs with a law of their own touch or part between here and `length`, the last pose.
  void locate_touches(double length) {
    const PoseResult &before = result_.poses[result_.poses.size() - 2],
                     &after = result_.poses.back();
    for (std::size_t p = 0; p < model_.pairs.size(); ++p) {
      const bool closes = after.contacts[p].closed;
      if (!model_.pairs[p].law || before.contacts[p].closed == closes) continue;
      double left = 0, right = length, value = after.value;
      while (right - left > 1e-9 * model_.length) {
        const double middle = 0.5 * (left + right);
        const std::optional<PathPoint> point = at(middle);
        if (!point) break;
        (touches(p, point->state.X) == closes ? right : left) = middle;
        value = point->value;
      }
      result_.events.push_back(
          {value, closes ? EventKind::kClosing : EventKind::kOpening, static_cast<int>(p)});
    }
  }

  bool touches(std::size_t pair, const RigidTransform& X) {
    searches_[pair].find_nearest(X, kAnywhere * model_.length, minima_);
    return !minima_.empty() && minima_.front().gap < 0;
  }

  /// The length at which the swept value passes `to`, where it does within `length`.
  std::optional<double> length_to_end(double length) {
    const double before = point_.value - to_;
    const std::optional<PathPoint> there = at(length);
    // A fold that begins and ends beyond the value within one step is not looked for.
    if (!there || before * (there->value - to_) > 0 || before == 0) return std::nullopt;
    double left = 0, right = length;
    for (int k = 0; k < 60 && right - left > 1e-6 * model_.length; ++k) {
      const double middle = 0.5 * (left + right);
      const std::optional<PathPoint> point = at(middle);
      if (!point) return std::nullopt;
      ((point->value - to_) * before > 0 ? left : right) = middle;
    }
    return right;
  }

  /// The last pose, with the swept value at `to` itself.
  bool finish(double length, double whole) {
    std::optional<PathPoint> last = at(length);
    Direction tangent;
    if (last && system_.tangent(*last, tangent)) {
      if (system_.product(tangent, tangent_) < 0) reverse(tangent);
      locate_limit(std::min(length, whole), tangent);
    }
    if (last) last->value = to_;
    if (!last || !system_.correct(*last, tangent_, true)) {
      stop(fmt::format("the path turns back just at {:.9g}", to_));
      return false;
    }
    last->value = to_;
    if (describe(*last)) locate_touches(length);
    return false;
  }

  Walker walker_;
  const Model& model_;
  double from_, to_, largest_step_;
  const PathOptions& options_;
  PathSystem system_;
  std::vector<ContactSearch> searches_;
  ContactRules rules_;
  std::vector<GapMinimum> minima_;
  PathPoint point_;
  Direction tangent_;
  SweepResult result_;
};

}  // namespace

SweepResult follow_path(EquilibriumSolver& solver,
                        const Swept& swept,
                        double from,
                        double to,
                        double largest_step,
                        const PathOptions& options) {
  const Drive drive = options.drive ? *options.drive : drive_of(solver.model());
  check_drive(drive, solver.model());
  if (from == to || !(largest_step > 0)) {
    SweepResult single;
    single.poses.push_back(solver.solve(swept.with(drive, from)));
    single.poses.back().value = from;
    return single;
  }
  return PathFollower(solver, swept, drive, from, to, largest_step, options).follow();
}

}  // namespace condyle
