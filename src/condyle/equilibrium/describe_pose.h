#pragma once

/// From a solved state to what is told about the pose.

#include <vector>

#include "condyle/contact/contact_search.h"
#include "condyle/equilibrium/linearization.h"
#include "condyle/equilibrium/pose_result.h"

namespace condyle {

struct PoseDescriptionOptions {
  double edge_margin = 3;  ///< a contact nearer than this to the edge of its patch is flagged [mm]
  bool stability = true;
  bool joint_stiffness = false;  ///< 6x6 stiffness and compliance; needs the model's joint
};

/// Fills a cleared result whose status says converged from a position of equilibrium. Lowers the
/// status where a contact lies beyond its patch or a body is buried in the other, and where a
/// contact law objects. `minima` is room for the search.
void describe_pose(const Linearization& at,
                   std::vector<ContactSearch>& searches,
                   const PoseDescriptionOptions& options,
                   std::vector<GapMinimum>& minima,
                   PoseResult& result);

}  // namespace condyle
