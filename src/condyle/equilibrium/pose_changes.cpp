#include "condyle/equilibrium/pose_changes.h"

#include <algorithm>

namespace condyle {
namespace {

bool beyond_edge(const PoseResult& pose, std::size_t contact) {
  const ContactResult& c = pose.contacts[contact];
  return c.closed &&
         std::any_of(c.points.begin(), c.points.end(),
                     [](const ContactPointResult& point) { return point.edge_distance < 0; });
}

}  // namespace

bool touches(const PoseResult& pose, std::size_t ligament, std::size_t wrap) {
  return pose.paths[ligament].touches[wrap].touching;
}

int points_of(const PoseResult& pose, std::size_t contact) {
  const ContactResult& c = pose.contacts[contact];
  return c.closed ? static_cast<int>(c.points.size()) : 0;
}

bool same_touches(const PoseResult& a, const PoseResult& b) {
  for (std::size_t i = 0; i < a.paths.size(); ++i)
    for (std::size_t w = 0; w < a.paths[i].touches.size(); ++w)
      if (touches(a, i, w) != touches(b, i, w)) return false;
  return true;
}

bool same_contacts(const PoseResult& a, const PoseResult& b) {
  for (std::size_t c = 0; c < a.contacts.size(); ++c)
    if (points_of(a, c) != points_of(b, c) || beyond_edge(a, c) != beyond_edge(b, c)) return false;
  return same_touches(a, b);
}

void append_changes(const PoseResult& before,
                    const PoseResult& after,
                    double value,
                    std::vector<Event>& events) {
  for (std::size_t c = 0; c < before.contacts.size(); ++c) {
    const int was = points_of(before, c), is = points_of(after, c);
    const auto add = [&](EventKind kind) { events.push_back({value, kind, static_cast<int>(c)}); };
    for (int k = was; k < is; ++k) add(EventKind::kClosing);
    for (int k = is; k < was; ++k) add(EventKind::kOpening);
    const bool was_out = beyond_edge(before, c), is_out = beyond_edge(after, c);
    if (was_out != is_out) add(is_out ? EventKind::kLeavingPatch : EventKind::kReturningToPatch);
  }
  for (std::size_t i = 0; i < after.paths.size(); ++i)
    for (std::size_t w = 0; w < after.paths[i].touches.size(); ++w) {
      const bool is = touches(after, i, w);
      if (is == touches(before, i, w)) continue;
      events.push_back({value, is ? EventKind::kTouching : EventKind::kLifting, -1,
                        static_cast<int>(i), static_cast<int>(w)});
    }
}

}  // namespace condyle
