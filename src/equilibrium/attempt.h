#pragma once

/// What an attempt to solve a pose leaves behind, whether it succeeds or not.

#include "equilibrium/descent.h"
#include "equilibrium/newton.h"

namespace condyle {

struct Attempt {
  int iterations = 0;     ///< of Newton and of the descent, over the whole attempt
  NewtonReport newton;    ///< the last
  DescentReport descent;  ///< the last
  bool faceless =
      false;  ///< in equilibrium, but the surfaces of an open pair are not over each other
};

}  // namespace condyle
