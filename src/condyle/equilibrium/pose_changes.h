#pragma once

/// What differs between two solved poses of one path of equilibria: points of contact that carry, contacts beyond the
/// edge of a surface, ligaments on the surfaces that they wrap on.

#include <vector>

#include "condyle/equilibrium/pose_result.h"

namespace condyle {

/// How many points of a contact carry.
[[nodiscard]] int points_of(const PoseResult& pose, std::size_t contact);

/// Does a ligament lie on one of the surfaces that it wraps on?
[[nodiscard]] bool touches(const PoseResult& pose, std::size_t ligament, std::size_t wrap);

/// Do the ligaments lie on the same surfaces?
[[nodiscard]] bool same_touches(const PoseResult& a, const PoseResult& b);

/// Do the same points carry as well, within the edges of their surfaces or beyond them?
[[nodiscard]] bool same_contacts(const PoseResult& a, const PoseResult& b);

/// An event at `value` for each difference.
void append_changes(const PoseResult& before,
                    const PoseResult& after,
                    double value,
                    std::vector<Event>& events);

}  // namespace condyle
