#pragma once

/// What an attempt to solve a pose leaves behind, whether it succeeds or not.

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "condyle/equilibrium/descent.h"
#include "condyle/equilibrium/newton.h"
#include "condyle/equilibrium/pose_trace.h"
#include "condyle/equilibrium/work.h"

namespace condyle {

/// An equilibrium off the known surfaces: a contact lies beyond an edge, an edge lies within the
/// other surface, or an open pair is not over each other.
struct OffSurfaces {
  EquilibriumState state;
  double beyond = std::numeric_limits<double>::infinity();  ///< an edge, or the edge's depth [mm]
  int contact = -1;                  ///< of the state that lies there; else -1
  std::optional<ClosedContact> rim;  ///< where an edge is deepest; it is none of the state
  PoseTrace trace;                   ///< by which way it was met
};

struct Attempt {
  Work most;               ///< after which nothing more is begun
  Work spent;              ///< over the whole attempt
  long points_before = 0;  ///< EquilibriumSolver::looked_at when it began
  PoseTrace trace;         ///< of the way under way; effort over the whole attempt
  NewtonReport newton;     ///< the last
  DescentReport descent;   ///< the last
  int zero_element = -1;   ///< that had no length on the way from the pose before
  std::string overflow;    ///< what had no finite force on the way, in words
  int passed_pair = -1;    ///< whose surfaces had passed through each other
  double depth = 0;        ///< by which they had [mm]
  /// Of those met with the values asked for the one least beyond an edge.
  std::optional<OffSurfaces> off;
  /// The first one met on the way to those values, else the last one the solver told of.
  std::optional<OffSurfaces> off_on_the_way;
  std::optional<RigidTransform> first_solution;  ///< of Newton, of the contacts of the last start
  /// The same of a start from where contacts did not settle; another start with the same contacts
  /// that leads there does not either.
  std::optional<RigidTransform> not_settled;
  /// From where the descent has been tried in vain with the values asked for.
  std::vector<RigidTransform> descended_from;
  std::optional<RigidTransform> other;  ///< a second position of equilibrium at the same values

  /// A way is begun.
  void begin(PoseRoute route, PoseOrigin origin) {
    trace.route = route;
    trace.origin = origin;
    trace.parts = 0;
    trace.residuals.clear();
  }
  /// The way told by `found` led to the pose.
  void found_by(const PoseTrace& found) {
    begin(found.route, found.origin);
    trace.parts = found.parts;
    trace.residuals = found.residuals;
  }
};

}  // namespace condyle
