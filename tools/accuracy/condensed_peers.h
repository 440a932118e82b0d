#pragma once

/// KINSOL and Ceres on the condensed equations of the quadric knee: six unknowns of the pose, the
/// forces of the contacts and the multiplier of the flexion, with derivatives by hand, as our
/// Newton has them. Contact points are no unknowns: at each pose they are where the gap is smallest.

#include <functional>
#include <string>
#include <vector>

#include "condyle/equilibrium/newton.h"

namespace condyle::accuracy {

struct CondensedResult {
  EquilibriumState state;
  int iterations = 0;
  bool converged = false;
};

struct CondensedPeer {
  std::string name;
  /// From a state with its closed contacts. Memory is kept from pose to pose, as ours is.
  std::function<CondensedResult(const EquilibriumState& start, const Drive& drive)> solve;
};

/// Those that were found when this was built. `model` outlives them.
[[nodiscard]] std::vector<CondensedPeer> condensed_peers(const Model& model);

}  // namespace condyle::accuracy
