#pragma once

/// From a solved state to what is told about the pose.

#include <vector>

#include "condyle/contact/contact_search.h"
#include "condyle/equilibrium/newton.h"
#include "condyle/equilibrium/pose_result.h"

namespace condyle {

struct PoseDescriptionOptions {
  double overlap = 5e-7;   ///< largest overlap of a converged pose [mm], and relative to L/30 mm
  double edge_margin = 3;  ///< a contact nearer than this to the edge of its patch is flagged [mm]
  bool stability = true;
  bool joint_stiffness = false;  ///< 6x6 stiffness and compliance; needs the model's joint
};

/// An empty result that keeps the memory of the one before.
void clear(PoseResult& result);

/// A point of contact with its force [N] and its distance from the nearest edge [mm]; whether that
/// counts as on the edge is left to the caller.
[[nodiscard]] ContactPointResult describe_point(const ContactLinearization& at,
                                                double force,
                                                double edge);

/// Force and resultant of a closed contact from its points.
void set_resultant(ContactResult& contact);

/// Fills a cleared result whose status says converged from the state at which `system` was
/// assembled. Lowers the status where a contact lies beyond its patch or a body is buried in the
/// other. `minima` is room for the search.
void describe_pose(const Model& model,
                   const NewtonSystem& system,
                   const EquilibriumState& state,
                   std::vector<ContactSearch>& searches,
                   const PoseDescriptionOptions& options,
                   std::vector<GapMinimum>& minima,
                   PoseResult& result);

}  // namespace condyle
