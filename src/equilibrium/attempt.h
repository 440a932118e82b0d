#pragma once

/// What an attempt to solve a pose leaves behind, whether it succeeds or not.

#include "equilibrium/descent.h"
#include "equilibrium/newton.h"

namespace condyle {

struct Attempt {
  int iterations = 0;     ///< of Newton and of the descent, over the whole attempt
  NewtonReport newton;    ///< the last
  DescentReport descent;  ///< the last
  int zero_element = -1;  ///< that had no length on the way from the pose before
  /// In equilibrium, but off the known surfaces: a contact far beyond an edge, or an open pair
  /// whose surfaces are not over each other.
  bool off_surfaces = false;
};

}  // namespace condyle
