/// Where contacts open and close and ligaments come to lie on surfaces or leave them: the path turns there.

#include <fmt/format.h>

#include <algorithm>

#include "condyle/equilibrium/path_follower.h"

namespace condyle {

ContactChanges PathFollower::changes_at(const PathPoint& point) {
  if (!system_.assemble(point)) return {};
  return rules_.changes(system_.linearization(point));
}

bool PathFollower::turn_corner() {
  PathPoint beyond = system_.ahead(point_, tangent_, kCorner * model_.length);
  Direction way;
  if (!told_ || !system_.revise(beyond) || !system_.tangent(beyond, way)) return false;
  if (system_.product(way, tangent_) < 0) reverse(way);
  for (int sense = 0; sense < 2; ++sense, reverse(way)) {
    PathPoint next = system_.ahead(beyond, way, kCorner * model_.length);
    SolvedPose there;
    if (!system_.correct(next, way) || changes_at(next).any() || !look_at(next, there)) continue;
    const std::vector<Event> found = changes(*told_, there.result, beyond.value);
    if (found.empty()) continue;
    for (const Event& event : found) located_.push_back({0, event});
    if (way.value() * tangent_.value() < 0)
      located_.push_back({0, {beyond.value, EventKind::kLimitPoint, -1}});
    point_ = next;
    tangent_ = way;
    told_ = std::move(there.result);
    return true;
  }
  return false;
}

PathFollower::Bracket PathFollower::first_change(double length) {
  Bracket part{0, length};
  while (part.after - part.before > 1e-12 * model_.length + 1e-14 * length) {
    const double middle = 0.5 * (part.before + part.after);
    const std::optional<PathPoint> point = at(middle);
    (point && !changes_at(*point).any() ? part.before : part.after) = middle;
  }
  return part;
}

bool PathFollower::change_contacts(const Bracket& part) {
  const double length = part.after;
  const std::optional<PathPoint> last = at(part.before), there = at(length);
  const ContactChanges changes = there ? changes_at(*there) : ContactChanges();
  if (!changes.any()) {
    stop("contacts could not be followed farther along the path");
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
    stop(fmt::format("no way on was found where contact \"{}\" is {}",
                     model_.pairs[static_cast<std::size_t>(pair)].name, name(kind)));
    return false;
  }
  if (been_at(changed)) return false;
  // Before it, as the solver itself would change contacts after it.
  Ahead unchanged;
  if (last) (void)look_ahead(*last, length, unchanged);
  located_.insert(located_.end(), unchanged.events.begin(), unchanged.events.end());
  if (unchanged.usable) told_ = std::move(unchanged.pose.result);
  located_.push_back({length, {changed.value, kind, pair}});
  if (after.value() * before.value() < 0)
    located_.push_back({length, {changed.value, EventKind::kLimitPoint, -1}});
  point_ = changed;
  tangent_ = after;
  // Where one of the two is no pose of equilibrium, what happened up to there is told from the other one.
  SolvedPose there_now;
  if (!look_at(point_, there_now)) return true;
  if (told_)
    for (const Event& event : this->changes(*told_, there_now.result, changed.value))
      located_.push_back({length, event});
  told_ = std::move(there_now.result);
  return true;
}

bool PathFollower::been_at(const PathPoint& point) {
  constexpr double kSame = 1e-7;  // [L]
  const auto same_pairs = [&](const PathPoint& turn) {
    const std::vector<ClosedContact>&then = turn.state.contacts, &now = point.state.contacts;
    return std::is_permutation(
        then.begin(), then.end(), now.begin(), now.end(),
        [](const ClosedContact& a, const ClosedContact& b) { return a.pair == b.pair; });
  };
  for (const PathPoint& turn : turns_)
    if (system_.distance(turn, point) < kSame * model_.length && same_pairs(turn)) {
      stop("the path closes on itself and does not come to its end");
      return true;
    }
  turns_.push_back(point);
  return false;
}

bool PathFollower::release(int contact, PathPoint& point, Direction& tangent) {
  system_.assemble(point);
  const ContactLinearization open =
      system_.linearization(point).contacts()[static_cast<std::size_t>(contact)];
  point.state.contacts.erase(point.state.contacts.begin() + contact);
  if (!settle(point, tangent)) return false;
  if (system_.gap_rate(open, tangent) < 0) reverse(tangent);
  return true;
}

bool PathFollower::close(const ClosedContact& contact, PathPoint& point, Direction& tangent) {
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

bool PathFollower::settle(PathPoint& point, Direction& tangent) {
  return system_.tangent(point, tangent) && system_.correct(point, tangent) &&
         system_.tangent(point, tangent);
}

}  // namespace condyle
