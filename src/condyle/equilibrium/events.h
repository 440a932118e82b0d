#pragma once

/// Events on a sweep, located on the swept value: a point of contact closes or opens, a contact
/// jumps from one place to another, or passes the edge of the known surface; a ligament comes to lie
/// on a surface that it wraps on, or leaves it.
///
/// Two neighbouring poses whose contacts differ enclose an event. Bisection, each trial solved from
/// the pose on the left, closes in until the bracket is shorter than the tolerance; several events
/// between two poses are found one after the other. Where a contact merely moved far, the half with
/// the greater part of the motion is followed: a motion that does not shrink with the bracket is a
/// jump. The body itself is followed likewise where it moved much farther than its path's tangent
/// foretold: where it jumps, its branch of equilibria ends in a limit point (snap-through). So it does where a contact
/// opens or closes and the branch that begins there leads back (corner_limit.h).

#include <optional>
#include <vector>

#include "condyle/equilibrium/walker.h"

namespace condyle {

struct EventOptions {
  double tolerance = 1e-9;  ///< of the swept value [rad], [mm] or [-]
  double far = 0.1;  ///< a contact that moved farther than this between two poses may have jumped,
                     ///< in units of L
  double jump =
      0.01;  ///< and has, when it still moves farther than this within the tolerance, in units of L
  double snap = 0.05;    ///< a body that moved farther than this, in units of L, may have snapped
                         ///< through
  int most_events = 64;  ///< located between two poses; further ones are told at the later one
  bool arrival = true;   ///< where the way from the left one goes on, say where it arrives
  /// On trials without equilibrium, and on all of them: after either no event more is looked for between the two
  /// poses, and what differs yet is told at the later one. Each is counted for itself: to close in on a limit point takes thousands of iterations and hardly a point.
  Work most_wasted{6000, 200000}, most{20000, 500000};
};

/// That of a sweep: factors of a load are as large or small as its vector asks for.
[[nodiscard]] double tolerance_of_events(const Swept& swept, const std::vector<double>& values);

struct EventsFound {
  std::optional<SolvedPose> instead;  ///< the pose in which the way from the left one arrives
  bool elsewhere = false;  ///< that way arrives beyond an edge: the right pose is on another branch
};

/// Appends the events between two poses of one sweep. The walker does not stay where it stood.
///
/// Where the way from `left` goes on to the very value of `right` and does not end there, `right` is on another
/// branch: Newton's steps may lead from one to another where they are long. Then the pose in which the way from
/// `left` arrives is given back, unless that one is unstable and `right` is stable, and no event is told; of one that
/// lies beyond an edge, what differs is told at the value of `right`.
[[nodiscard]] EventsFound locate_events(Walker& walker,
                                        const SolvedPose& left,
                                        const SolvedPose& right,
                                        std::vector<Event>& events,
                                        const EventOptions& options = {});

}  // namespace condyle
