#include "condyle/equilibrium/events.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "condyle/equilibrium/closing_event.h"
#include "condyle/equilibrium/corner_limit.h"
#include "condyle/equilibrium/path_system.h"
#include "condyle/equilibrium/pose_changes.h"
#include "condyle/math/pose_step.h"

namespace condyle {
namespace {

constexpr double kStraight = 1e-4;  // part of a step over which gaps change in proportion

/// Foretells where an arc on a surface vanishes, from the poses that lie on it as they close in.
class VanishingArc {
 public:
  /// Of the first ligament and surface on which two poses differ, if only one lies on it.
  VanishingArc(const PoseResult& a, const PoseResult& b) {
    for (std::size_t i = 0; i < a.paths.size(); ++i)
      for (std::size_t w = 0; w < a.paths[i].touches.size(); ++w)
        if (!found_ && touches(a, i, w) != touches(b, i, w)) found_ = {i, w};
  }

  void add(const SolvedPose& pose) {
    if (!found_ || !touches(pose.result, found_->first, found_->second)) return;
    before_ = last_;
    last_ = {pose.value, pose.result.paths[found_->first].touches[found_->second].arc};
  }

  /// Where to try next between two values: just beyond where the arc vanishes on the line through the
  /// last two, on the side of the end that is farther from there. Nothing where that says nothing.
  std::optional<double> trial(double left, double right, double tolerance) {
    if (!before_ || !last_ || before_->arc == last_->arc) return std::nullopt;
    const double value =
        last_->value - last_->arc * (before_->value - last_->value) / (before_->arc - last_->arc);
    const double off = guess_ ? 2 * std::abs(value - *guess_) : INFINITY;
    guess_ = value;
    const double width = std::abs(right - left);
    const double aside = std::min(std::max(off, 0.3 * tolerance), 0.25 * width);
    const double to = std::abs(left - value) > std::abs(right - value) ? left : right;
    const double next = value + std::copysign(aside, to - value);
    const bool inside = (next - left) * (right - next) > 0;
    return inside ? std::optional(next) : std::nullopt;
  }

 private:
  struct Arc {
    double value, arc;
  };
  std::optional<std::pair<std::size_t, std::size_t>> found_;
  std::optional<Arc> before_, last_;
  std::optional<double> guess_;
};

/// How far the points of a contact moved on either body, where their number is the same [mm]; of a
/// layer its centre of pressure, since where it is pressed most may change over at once.
double motion(const PoseResult& a, const PoseResult& b, std::size_t contact) {
  if (a.contacts[contact].layer && b.contacts[contact].layer) {
    const Eigen::Vector3d &p = a.contacts[contact].resultant_ground,
                          &q = b.contacts[contact].resultant_ground;
    return std::max((p - q).norm(), (a.X_BA.inverse() * p - b.X_BA.inverse() * q).norm());
  }
  const auto& from = a.contacts[contact].points;
  const auto& to = b.contacts[contact].points;
  if (points_of(a, contact) == 0 || from.size() != to.size()) return 0;
  double largest = 0;
  for (const ContactPointResult& p : from) {
    double nearest = INFINITY;
    for (const ContactPointResult& q : to)
      nearest = std::min(nearest, std::max((p.point_ground - q.point_ground).norm(),
                                           (p.point_moving - q.point_moving).norm()));
    largest = std::max(largest, nearest);
  }
  return largest;
}

double body_motion(const SolvedPose& from, const SolvedPose& to, double L) {
  return distance_between(from.state.X, to.state.X, L);
}

void append_limit(const SolvedPose& before, const SolvedPose& after, std::vector<Event>& events) {
  events.push_back({0.5 * (before.value + after.value), EventKind::kLimitPoint, -1});
}

class EventSearch {
 public:
  EventSearch(Walker& walker, const EventOptions& options) : walker_(walker), options_(options) {
    const std::vector<ContactPair>& pairs = walker.model().pairs;
    if (std::none_of(pairs.begin(), pairs.end(), [](const ContactPair& p) { return bool(p.law); }))
      return;
    options_.most = options_.most.with_laws();
    options_.most_wasted = options_.most_wasted.with_laws();
  }

  /// The pose at a value, from another one; nothing where it has no equilibrium.
  std::optional<SolvedPose> pose_at(double value, const SolvedPose& from) {
    if (wasted_.reaches(options_.most_wasted) || spent_.reaches(options_.most)) return std::nullopt;
    walker_.stand_at(from);
    SolvedPose pose;
    const bool solved = walker_.step(value, Patience::kNone, pose);
    spent_.add(walker_.solver().spent());
    if (solved) return pose;
    wasted_.add(walker_.solver().spent());
    return std::nullopt;
  }

  /// A pose between two others: half way, or near it where that has no equilibrium from either
  /// side.
  std::optional<SolvedPose> between(const SolvedPose& left, const SolvedPose& right) {
    for (const double part : {0.5, 0.35, 0.65, 0.42, 0.58}) {
      const double value = left.value + part * (right.value - left.value);
      for (const SolvedPose* from : {&left, &right})
        if (std::optional<SolvedPose> pose = pose_at(value, *from)) return pose;
    }
    return std::nullopt;
  }

  /// Closes in on the first change of contacts right of `left`; false where a trial has no
  /// equilibrium.
  bool bisect_change(SolvedPose& left, SolvedPose& right) {
    VanishingArc arc(left.result, right.result);
    arc.add(left);
    arc.add(right);
    bool halved = true;  // the last step was at least as good as bisection
    for (double width = std::abs(right.value - left.value); width > options_.tolerance;) {
      std::optional<SolvedPose> middle;
      if (const auto value = arc.trial(left.value, right.value, options_.tolerance);
          value && halved)
        middle = pose_at(*value, left);
      if (!middle) middle = between(left, right);
      if (!middle) return false;
      arc.add(*middle);
      (same_contacts(left.result, middle->result) ? left : right) = *middle;
      const double before = std::exchange(width, std::abs(right.value - left.value));
      halved = !halved || width < 0.5 * before;
    }
    return true;
  }

  /// Does the body lie elsewhere, as no motion within the tolerance explains?
  [[nodiscard]] bool jumps(const SolvedPose& before, const SolvedPose& after) const {
    const double L = walker_.model().length;
    return body_motion(before, after, L) >= options_.jump * L;
  }

  /// Does the path turn back where a contact opens or closes between two poses, and the body lie on another branch at
  /// the next one?
  bool snaps_at_corner(const SolvedPose& before, const SolvedPose& after, const SolvedPose& next) {
    return moved_unexpectedly(after, next) &&
           turns_back(path_at(after.value), walker_.model(), before, after);
  }

  /// Did the body go much farther than the tangents of its path say at either end?
  bool moved_unexpectedly(const SolvedPose& left, const SolvedPose& right) {
    constexpr double kMuch = 2;
    const double L = walker_.model().length;
    const double moved = body_motion(left, right, L);
    if (moved < options_.snap * L) return false;
    const double foretold = std::min(foretold_motion(left, right), foretold_motion(right, left));
    return moved > kMuch * foretold;
  }

  /// Follows the greater part of the motion of the body; true when it stays a jump.
  bool bisect_snap(SolvedPose& left, SolvedPose& right) {
    const double L = walker_.model().length;
    while (std::abs(right.value - left.value) > options_.tolerance) {
      if (!jumps(left, right)) return false;
      std::optional<SolvedPose> middle = between(left, right);
      if (!middle) return false;
      const bool in_left = body_motion(left, *middle, L) > body_motion(*middle, right, L);
      (in_left ? right : left) = *middle;
    }
    return jumps(left, right);
  }

  /// Follows the greater part of the motion of one contact; true when it stays a jump.
  bool bisect_jump(SolvedPose& left, SolvedPose& right, std::size_t contact, double jump) {
    while (std::abs(right.value - left.value) > options_.tolerance) {
      if (motion(left.result, right.result, contact) < jump) return false;
      std::optional<SolvedPose> middle = between(left, right);
      if (!middle || !same_contacts(left.result, middle->result)) return false;
      const bool in_left = motion(left.result, middle->result, contact) >
                           motion(middle->result, right.result, contact);
      (in_left ? right : left) = *middle;
    }
    return motion(left.result, right.result, contact) >= jump;
  }

  /// Where between two poses on either side of a change it lies: where a gap closes, or half way, as where the body
  /// jumps. `length` of the sweep on which the gaps are as good as straight.
  double exact_value(const SolvedPose& before, const SolvedPose& after, double length) {
    const double middle = 0.5 * (before.value + after.value);
    if (jumps(before, after)) return middle;
    const std::optional<SolvedPose> earlier =
        pose_at(before.value - std::copysign(length, after.value - before.value), before);
    if (!earlier || !same_contacts(earlier->result, before.result)) return middle;
    return closing_value(walker_.model(), walker_.solver().searches(), *earlier, before, after)
        .value_or(middle);
  }

  /// The pose of equilibrium in which the way from `before` arrives at the value of `right`, if it goes on past `after`,
  /// which lies within the tolerance of it; nothing where the way ends between, or arrives in `right` itself.
  std::optional<SolvedPose> arrival(const SolvedPose& before,
                                    const SolvedPose& after,
                                    const SolvedPose& right) {
    if (!options_.arrival) return std::nullopt;
    std::optional<SolvedPose> there = pose_at(after.value, before);
    if (!there || jumps(before, *there)) return std::nullopt;
    if (after.value != right.value) there = pose_at(right.value, *there);
    if (!there || !jumps(*there, right)) return std::nullopt;
    const bool falls = there->result.stability == 0 && right.result.stability == 1;
    return falls ? std::nullopt : there;
  }

 private:
  PathSystem& path_at(double value) {
    if (!path_) {
      path_.emplace(walker_.model(), walker_.swept(), walker_.drive_at(value), 1);
      path_->set_parameters(walker_.solver().parameters());
    }
    return *path_;
  }

  /// What the tangent at one pose says about the way to the value of another [mm].
  double foretold_motion(const SolvedPose& at, const SolvedPose& to) {
    PathSystem::Direction tangent;
    if (!path_at(at.value).tangent({at.state, at.value}, tangent) || tangent.value() == 0)
      return INFINITY;
    double square = 0;
    for (std::size_t i = 0; i < 6; ++i) square += tangent.d[i] * tangent.d[i];
    return std::sqrt(square) * std::abs((to.value - at.value) / tangent.value());
  }

  Walker& walker_;
  std::optional<PathSystem> path_;  ///< once it is asked for
  EventOptions options_;
  Work spent_, wasted_;  ///< on trials; on those without equilibrium
};

/// What happened between two poses, told in order.
class EventLocator {
 public:
  EventLocator(Walker& walker,
               const SolvedPose& left,
               const SolvedPose& right,
               std::vector<Event>& events,
               const EventOptions& options)
      : search_(walker, options),
        options_(options),
        left_(left),
        right_(right),
        events_(events),
        told_(events.size()),
        L_(walker.model().length),
        straight_(kStraight * std::abs(right.value - left.value)) {}

  EventsFound locate() {
    if (!tell_changes() || snapped_ || !same_contacts(left_.result, right_.result)) return found_;
    if (tell_snap()) return found_;
    for (std::size_t c = 0; c < left_.result.contacts.size() && !found_.instead; ++c) tell_jump(c);
    return found_;
  }

 private:
  /// Points of contact that open and close, one after the other; false where nothing more is to be told.
  bool tell_changes() {
    SolvedPose from = left_;
    for (int k = 0; k < options_.most_events && !same_contacts(from.result, right_.result); ++k) {
      SolvedPose before = from, after = right_;
      if (!search_.bisect_change(before, after)) break;  // where it lies is not known
      const bool jumps = search_.jumps(before, after);
      if (jumps && goes_on(before, after)) return false;
      if (jumps) append_limit(before, after, events_);
      snapped_ = snapped_ || jumps;
      const double value = search_.exact_value(before, after, straight_);
      append_changes(before.result, after.result, value, events_);
      from = after;
      if (jumps || !search_.snaps_at_corner(before, after, right_)) continue;
      events_.push_back({value, EventKind::kLimitPoint, -1});
      snapped_ = true;
      const std::optional<SolvedPose> beyond = search_.pose_at(after.value, right_);
      if (!beyond || !search_.jumps(after, *beyond)) break;
      append_changes(after.result, beyond->result, value, events_);
      from = *beyond;
    }
    append_changes(from.result, right_.result, right_.value, events_);
    return true;
  }

  /// The body elsewhere with the same contacts; those that jump with it are not told of again.
  bool tell_snap() {
    if (!search_.moved_unexpectedly(left_, right_)) return false;
    SolvedPose before = left_, after = right_;
    if (!search_.bisect_snap(before, after)) return false;
    if (!goes_on(before, after)) append_limit(before, after, events_);
    return true;
  }

  void tell_jump(std::size_t contact) {
    if (motion(left_.result, right_.result, contact) < options_.far * L_) return;
    SolvedPose before = left_, after = right_;
    if (!search_.bisect_jump(before, after, contact, options_.jump * L_)) return;
    if (goes_on(before, after)) return;
    events_.push_back({search_.exact_value(before, after, straight_), EventKind::kJump,
                       static_cast<int>(contact)});
  }

  /// Does the way from the left pose go on? It then arrives in a pose that takes the place of the right one, and what was
  /// told is not so; or beyond an edge, in one that counts for less: what differs is told at the right one's value.
  bool goes_on(const SolvedPose& before, const SolvedPose& after) {
    std::optional<SolvedPose> there = search_.arrival(before, after, right_);
    if (!there) return false;
    events_.resize(told_);
    if (there->result.converged()) {
      found_.instead = std::move(there);
    } else {
      found_.elsewhere = true;
      append_changes(left_.result, right_.result, right_.value, events_);
    }
    return true;
  }

  EventSearch search_;
  EventOptions options_;
  const SolvedPose &left_, &right_;
  std::vector<Event>& events_;
  std::size_t told_;  ///< before these
  double L_, straight_;
  bool snapped_ = false;
  EventsFound found_;
};

}  // namespace

double tolerance_of_events(const Swept& swept, const std::vector<double>& values) {
  constexpr double kTolerance = EventOptions().tolerance;
  constexpr double kRounding = 4 * std::numeric_limits<double>::epsilon();
  double largest = 0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  const double least = swept.is_load() && largest > 0 ? std::min(1.0, largest) : 1;
  return std::max(kTolerance * least, kRounding * largest);
}

EventsFound locate_events(Walker& walker,
                          const SolvedPose& left,
                          const SolvedPose& right,
                          std::vector<Event>& events,
                          const EventOptions& options) {
  return EventLocator(walker, left, right, events, options).locate();
}

}  // namespace condyle
